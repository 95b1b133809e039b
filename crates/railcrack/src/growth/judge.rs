//! Judges of tips: user-defined growth laws and direction criteria.

use super::TipRecord;
use crate::fracture::SifHistory;
use std::fmt::Debug;

/// A judge of tips, which replaces the direction criterion and the growth law of the settings.
pub trait TipJudge: Debug + Send + Sync {
    /// Judges a tip by `history`, K through its stabilised passage (MPa √mm). The record of the
    /// `tip` contains its state and loading, and the direction and rate given by the settings,
    /// which may be overwritten.
    fn judge(&self, history: &SifHistory, tip: &mut TipRecord);
}
