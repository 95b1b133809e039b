//! The model against measured numbers: entries, the distribution predicted under their conditions,
//! scores.

mod computed;
mod folder;
mod score;
mod shipped;
mod straight;

pub use computed::{Conditions, Predicted};
pub use folder::{Space, Validated, Validation, ValidationError};
pub use score::{GradeScore, Residuals, Score, grade_scores};
