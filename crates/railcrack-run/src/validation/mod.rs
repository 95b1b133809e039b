//! The model against measured numbers: entries, the distribution predicted under their conditions,
//! scores.

mod computed;
mod folder;
mod score;
mod scores;
mod shipped;
mod straight;
mod table;

pub use computed::{Conditions, Predicted};
pub use folder::{Space, Validated, Validation, ValidationError};
pub use score::{GradeScore, Residuals, Score, grade_scores};
pub use scores::Scores;
pub use table::validation_table;
