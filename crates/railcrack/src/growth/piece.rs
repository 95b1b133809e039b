//! Pieces of the rail that cracks, or cracks and the running surface, enclose.

use crate::math::Vec2;
use crate::words::{Choice, Word};
use serde::{Deserialize, Serialize};

/// Kinds of pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum PieceKind {
    /// A tip broke out at the running surface: what lies above the crack. Its ligament is still
    /// there, and the run goes on.
    Spall,
    /// A tip coalesced with a crack: nothing holds the piece any more.
    Detached,
}

impl Choice for PieceKind {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Spall, Word::now("spall", "above a crack that broke out at the running surface")),
        (Self::Detached, Word::now("detached", "wholly cut off")),
    ];
}

/// A piece of the rail that is enclosed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// Its kind.
    pub kind: PieceKind,
    /// In which step.
    pub step: usize,
    /// Index of the crack whose tip closed the outline, from 0.
    pub crack: usize,
    /// Its corners in order, mm; the last is joined to the first.
    pub outline: Vec<Vec2>,
    /// Its area, mm².
    pub area: f64,
}

impl Piece {
    /// The piece within `outline`.
    pub(crate) fn new(kind: PieceKind, step: usize, crack: usize, outline: Vec<Vec2>) -> Self {
        let next = outline.iter().cycle().skip(1);
        let twice: f64 = outline.iter().zip(next).map(|(a, b)| a.cross(*b)).sum();
        Self { kind, step, crack, area: 0.5 * twice.abs(), outline }
    }
}
