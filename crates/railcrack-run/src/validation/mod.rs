//! The model against measured numbers: entries, the distribution predicted under their conditions,
//! scores.

mod computed;
mod folder;
mod score;
mod shipped;

pub use computed::{Conditions, Predicted};
pub use folder::{Validated, Validation, ValidationError};
pub use score::{GradeScore, Score, grade_scores};
