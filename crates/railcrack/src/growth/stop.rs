//! Reasons for which tips stop and runs end.

use crate::crack::CrackEnd;
use crate::math::Vec2;
use crate::words::{Choice, Word};
use serde::{Deserialize, Serialize};

/// A tip that broke out, with the point at which its ligament ends on the running surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BreakOut {
    /// The tip, which stays where it was.
    pub tip: CrackEnd,
    /// The point of the surface, mm.
    pub surface: Vec2,
}

/// Why a tip stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum TipStop {
    /// ΔK_eq at or below the threshold, or a rate below the arrest rate.
    Arrest,
    /// The ligament to the running surface is used up: a spall forms.
    BreakOut,
    /// It joins a crack with the increment of this step; without an increment, it has come too
    /// close to the crack for a junction to be made.
    Coalescence,
    /// The next increment would leave the rail.
    LeavesRail,
    /// The largest k1 of its passage reaches the toughness: the rail fractures.
    Fracture,
    /// Wear and grinding have removed the whole crack.
    WornAway,
}

const ARREST: Word = Word::now("arrest", "at or below the threshold or the arrest rate");
const BREAK_OUT: Word = Word::now("break-out", "at the running surface");
const COALESCENCE: Word = Word::now("meets-crack", "coalescence");
const LEAVES_RAIL: Word = Word::now("leaves-rail", "the next increment would leave the rail");
const FRACTURE: Word = Word::now("fracture", "the largest k1 reaches the toughness");
const WORN_AWAY: Word = Word::now("worn-away", "wear and grinding have taken the whole crack");

impl Choice for TipStop {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Arrest, ARREST),
        (Self::BreakOut, BREAK_OUT),
        (Self::Coalescence, COALESCENCE),
        (Self::LeavesRail, LEAVES_RAIL),
        (Self::Fracture, FRACTURE),
        (Self::WornAway, WORN_AWAY),
    ];
}

/// Why the run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum RunStop {
    /// All increments are done.
    StepsDone,
    /// The requested number of load cycles is reached.
    Cycles,
    /// A crack reached the critical length.
    CriticalLength,
    /// A tip reached the critical depth, with which the answer is known.
    CriticalDepth,
    /// A piece of the rail is fully detached.
    Detached,
    /// No tip grows; the reason given by the last tip that stopped.
    NoTipGrows(TipStop),
    /// The largest k1 of a tip reaches the toughness: the rail fractures.
    Fracture,
    /// Wear and grinding have removed as much as the rail may lose: it is replaced.
    WearLimit,
}

/// Where no tip grows, the word is that of the last tip that stopped.
impl Choice for RunStop {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::StepsDone, Word::now("steps-done", "all increments done")),
        (Self::Cycles, Word::now("cycles", "the number of load cycles asked for")),
        (Self::CriticalLength, Word::now("critical-length", "a crack is as long as asked for")),
        (Self::CriticalDepth, Word::now("critical-depth", "a tip is as deep as asked for")),
        (Self::Detached, Word::now("detached", "a piece of the rail is wholly cut off")),
        (Self::Fracture, FRACTURE),
        (Self::WearLimit, Word::now("wear-limit", "the rail is worn to the limit at which it is replaced")),
        (Self::NoTipGrows(TipStop::Arrest), ARREST),
        (Self::NoTipGrows(TipStop::BreakOut), BREAK_OUT),
        (Self::NoTipGrows(TipStop::Coalescence), COALESCENCE),
        (Self::NoTipGrows(TipStop::LeavesRail), LEAVES_RAIL),
        (Self::NoTipGrows(TipStop::Fracture), FRACTURE),
        (Self::NoTipGrows(TipStop::WornAway), WORN_AWAY),
    ];
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stop_reads_back() {
        for (stop, word) in TipStop::WORDS {
            assert_eq!((stop.word(), TipStop::of_word(word.name)), (word.name, Some(*stop)));
        }
        for (stop, word) in RunStop::WORDS {
            assert_eq!(
                (stop.word(), RunStop::of_word(word.name).map(Choice::word)),
                (word.name, Some(word.name))
            );
        }
        assert_eq!(RunStop::of_word("fracture"), Some(RunStop::Fracture));
    }
}
