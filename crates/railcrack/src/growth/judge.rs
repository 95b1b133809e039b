//! Judges of tips: laws and criteria of one's own.

use super::TipRecord;
use crate::fracture::SifHistory;
use std::fmt::Debug;

/// A judge of tips, in place of the criterion of direction and the growth law of the settings.
pub trait TipJudge: Debug + Send + Sync {
    /// Judges a tip by `history`, K through its stabilised passage (MPa √mm). The state and the
    /// demand of the `tip` are in its record, with direction and rate of the settings, which may be
    /// replaced.
    fn judge(&self, history: &SifHistory, tip: &mut TipRecord);
}
