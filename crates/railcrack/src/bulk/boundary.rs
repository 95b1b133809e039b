//! Boundary conditions of the meshed rail.

use crate::mesh::QuadMesh;
use crate::words::{Choice, Word};

/// The support of the bottom of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BottomSupport {
    /// No displacement.
    Clamped,
    /// No vertical displacement. If no other support restrains the block along x, the node nearest
    /// to the middle of the bottom is fixed.
    Rollers,
}

impl Choice for BottomSupport {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Clamped, Word::now("clamped", "no displacement")),
        (Self::Rollers, Word::now("rollers", "no vertical displacement, one point held along x")),
    ];
}

/// The support of the left and right sides of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SideSupport {
    /// No traction.
    Free,
    /// No horizontal displacement.
    Rollers,
    /// No displacement.
    Clamped,
}

impl Choice for SideSupport {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Free, Word::now("free", "no traction")),
        (Self::Rollers, Word::now("rollers", "no horizontal displacement")),
        (Self::Clamped, Word::now("clamped", "no displacement")),
    ];
}

/// The boundary of the meshed rail; its top is always free.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Boundary {
    /// A half-plane. The mesh ends far away, where all its sides except the top are held.
    HalfPlane,
    /// A block.
    Block {
        /// Support of the bottom.
        bottom: BottomSupport,
        /// Support of the sides.
        sides: SideSupport,
    },
}

const fn block(bottom: BottomSupport, sides: SideSupport) -> Boundary {
    Boundary::Block { bottom, sides }
}

/// The boundary of a block with these supports.
impl Choice for Boundary {
    const WORDS: &'static [(Self, Word)] = {
        use {BottomSupport as Bottom, SideSupport as Sides};
        &[
            (Self::HalfPlane, Word::now("half-plane", "bounded by the running surface only")),
            (block(Bottom::Clamped, Sides::Free), Word::now("block, bottom clamped, sides free", BLOCK)),
            (
                block(Bottom::Clamped, Sides::Rollers),
                Word::now("block, bottom clamped, sides rollers", BLOCK),
            ),
            (
                block(Bottom::Clamped, Sides::Clamped),
                Word::now("block, bottom clamped, sides clamped", BLOCK),
            ),
            (block(Bottom::Rollers, Sides::Free), Word::now("block, bottom rollers, sides free", BLOCK)),
            (
                block(Bottom::Rollers, Sides::Rollers),
                Word::now("block, bottom rollers, sides rollers", BLOCK),
            ),
            (
                block(Bottom::Rollers, Sides::Clamped),
                Word::now("block, bottom rollers, sides clamped", BLOCK),
            ),
        ]
    };
}

const BLOCK: &str = "a rectangle on supports";

/// Whether a displacement component is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Freedom {
    Free,
    Held,
}

use Freedom::{Free, Held};

impl Boundary {
    /// Freedom along x and y of a side, left or right.
    pub(super) fn side(self) -> [Freedom; 2] {
        match self {
            Self::HalfPlane | Self::Block { sides: SideSupport::Clamped, .. } => [Held, Held],
            Self::Block { sides: SideSupport::Rollers, .. } => [Held, Free],
            Self::Block { sides: SideSupport::Free, .. } => [Free, Free],
        }
    }

    /// Freedom along x and y of the bottom.
    pub(super) fn bottom(self) -> [Freedom; 2] {
        match self {
            Self::HalfPlane | Self::Block { bottom: BottomSupport::Clamped, .. } => [Held, Held],
            Self::Block { bottom: BottomSupport::Rollers, .. } => [Free, Held],
        }
    }

    /// The freedom of every node along x and y: a corner is held by each of its two sides.
    pub(super) fn nodes(self, mesh: &QuadMesh) -> Vec<[Freedom; 2]> {
        let last = 2 * mesh.columns();
        let mut nodes = vec![[Free, Free]; mesh.node_count()];
        for (node, freedom) in nodes.iter_mut().enumerate() {
            let (c, r) = mesh.lattice_point(node);
            let ends = [(c == 0 || c == last).then(|| self.side()), (r == 0).then(|| self.bottom())];
            for held_by in ends.into_iter().flatten() {
                for (axis, held) in freedom.iter_mut().zip(held_by) {
                    if held == Held {
                        *axis = Held;
                    }
                }
            }
        }
        if nodes.iter().all(|[x, _]| *x == Free) {
            let [from, to] = [mesh.x_lines()[0], mesh.x_lines()[mesh.columns()]];
            let from_middle =
                |c: &usize| (mesh.node_position(mesh.node_at(*c, 0)).x - 0.5 * (from + to)).abs();
            let middle = (0..=last).min_by(|a, b| from_middle(a).total_cmp(&from_middle(b))).unwrap_or(0);
            nodes[mesh.node_at(middle, 0)][0] = Held;
        }
        nodes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: usize = 5;

    /// Freedom at the left side, at its corner with the bottom, and at the bottom.
    fn around(boundary: Boundary) -> [[Freedom; 2]; 3] {
        let lines = |n: usize| (0..=n).map(|i| i as f64).collect();
        let mesh = QuadMesh::new(lines(COLUMNS), lines(2)).unwrap();
        let nodes = boundary.nodes(&mesh);
        for (c, r) in (1..2 * COLUMNS).flat_map(|c: usize| (1..=4_usize).map(move |r| (c, r))) {
            if c.is_multiple_of(2) || r.is_multiple_of(2) {
                assert_eq!(nodes[mesh.node_at(c, r)], [Free, Free], "({c}, {r})");
            }
        }
        for r in 0..=4 {
            assert_eq!(nodes[mesh.node_at(0, r)], nodes[mesh.node_at(2 * COLUMNS, r)], "both sides alike");
        }
        let held_along_x = (1..2 * COLUMNS).filter(|&c| nodes[mesh.node_at(c, 0)][0] == Held);
        let free_along_x = boundary.bottom()[0] == Free;
        let alone = free_along_x && boundary.side()[0] == Free;
        let want = if alone {
            vec![COLUMNS]
        } else if free_along_x {
            vec![]
        } else {
            (1..2 * COLUMNS).collect()
        };
        assert_eq!(held_along_x.collect::<Vec<_>>(), want, "{boundary:?}");
        [(0, 3), (0, 0), (2, 0)].map(|(c, r)| nodes[mesh.node_at(c, r)])
    }

    #[test]
    fn supports_restrain_the_components_in_their_names() {
        use BottomSupport as Bottom;
        use SideSupport as Side;
        let block = |bottom, sides| around(Boundary::Block { bottom, sides });
        let (no, x, y, both) = ([Free, Free], [Held, Free], [Free, Held], [Held, Held]);
        assert_eq!(around(Boundary::HalfPlane), [both, both, both]);
        assert_eq!(block(Bottom::Clamped, Side::Free), [no, both, both]);
        assert_eq!(block(Bottom::Clamped, Side::Rollers), [x, both, both]);
        assert_eq!(block(Bottom::Clamped, Side::Clamped), [both, both, both]);
        assert_eq!(block(Bottom::Rollers, Side::Free), [no, y, y]);
        assert_eq!(block(Bottom::Rollers, Side::Rollers), [x, both, y]);
        assert_eq!(block(Bottom::Rollers, Side::Clamped), [both, both, y]);
    }
}
