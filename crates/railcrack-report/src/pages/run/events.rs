//! Coalescence of cracks, and pieces of the rail that cracks enclose.

use super::stored::RunFolder;
use crate::numbers::{fixed, grouped, significant, tonnage};
use crate::page::Fact;
use crate::table::Table;
use railcrack::growth::{PieceKind, RunStop, TipStop};
use railcrack::words::Choice;
use railcrack_run::{JunctionSummary, PieceSummary};

/// Maximum number of sentences per kind of event; further events are counted.
const OF_A_KIND: usize = 3;

/// An enclosed piece: its extent, and the time at which a tip closed its outline.
struct Enclosed<'a> {
    piece: &'a PieceSummary,
    /// Number of the tip within its crack.
    tip: Option<usize>,
    /// Load cycles up to the end of the step.
    cycles: f64,
    /// Along the rail, mm.
    across: f64,
    /// Depth of its lowest corner, mm.
    depth: f64,
}

impl<'a> Enclosed<'a> {
    fn of(run: &RunFolder, piece: &'a PieceSummary) -> Self {
        let extent = |c: usize| {
            let all = piece.outline_mm.iter().map(|corner| corner[c]);
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
        };
        let ((left, right), (bottom, _)) = (extent(0), extent(1));
        let rows = run.growth.iter().filter(|row| row.step == piece.step && row.crack == piece.crack);
        let closed = rows.filter(|row| row.stop.is_some()).map(|row| row.tip).next();
        let after = run.growth.iter().find(|row| row.step == piece.step + 1);
        let cycles = after.map_or(run.summary.load_cycles, |row| row.load_cycles);
        Self { piece, tip: closed, cycles, across: right - left, depth: -bottom }
    }

    /// `crack 2, tip 1`.
    fn by(&self) -> String {
        match self.tip {
            Some(tip) => format!("crack {}, tip {tip}", self.piece.crack),
            None => format!("crack {}", self.piece.crack),
        }
    }
}

/// The events, one sentence each.
pub(super) fn sentences(run: &RunFolder) -> Vec<String> {
    let mut texts = Vec::new();
    let (pieces, junctions) = (&run.summary.pieces, &run.summary.junctions);
    for piece in pieces.iter().take(OF_A_KIND) {
        let enclosed = Enclosed::of(run, piece);
        let name = if piece.kind == PieceKind::Spall { "A spall" } else { "A detached piece" };
        texts.push(format!(
            "{name} of {} mm², {} mm long and {} mm deep, is cut off by {} in growth step {}, after {} load cycles.",
            significant(piece.area_mm2),
            fixed(enclosed.across, 2),
            fixed(enclosed.depth, 2),
            enclosed.by(),
            piece.step,
            grouped(enclosed.cycles)
        ));
    }
    for JunctionSummary { crack, onto, x_mm, y_mm, .. } in junctions.iter().take(OF_A_KIND) {
        texts.push(format!(
            "Crack {crack} joins crack {onto} {} mm below the surface, at x = {} mm.",
            fixed(-y_mm, 2),
            fixed(*x_mm, 2)
        ));
    }
    let more = pieces.len().saturating_sub(OF_A_KIND) + junctions.len().saturating_sub(OF_A_KIND);
    if more > 0 {
        texts.push(format!("{more} more pieces and junctions are listed in the table below."));
    }
    texts
}

/// The largest piece as a key figure.
pub(super) fn fact(run: &RunFolder) -> Option<Fact> {
    let pieces = &run.summary.pieces;
    let largest = pieces.iter().max_by(|one, other| one.area_mm2.total_cmp(&other.area_mm2))?;
    let enclosed = Enclosed::of(run, largest);
    let name = if largest.kind == PieceKind::Spall { "Spall" } else { "Detached piece" };
    let all = if pieces.len() > 1 { format!(", the largest of {}", pieces.len()) } else { String::new() };
    Some(Fact::new(
        name.to_owned(),
        format!("{} mm²", significant(largest.area_mm2)),
        format!(
            "{}, step {}; {} mm long, {} mm deep{all}",
            enclosed.by(),
            largest.step,
            fixed(enclosed.across, 2),
            fixed(enclosed.depth, 2)
        ),
    ))
}

/// Table of all pieces and junctions; none without any.
pub(super) fn table(run: &RunFolder) -> Option<Table> {
    let (pieces, junctions) = (&run.summary.pieces, &run.summary.junctions);
    if pieces.is_empty() && junctions.is_empty() {
        return None;
    }
    let load = run.case.axle_load;
    let mut headings = vec![
        "Event",
        "By",
        "Step",
        "Load cycles",
        "x (mm)",
        "Depth (mm)",
        "Area (mm^{2})",
        "Corners of the outline",
    ];
    if load.is_some() {
        headings.insert(4, "Million gross tonnes");
    }
    let mut table = Table::new(headings);
    table.caption =
        "Pieces of the rail enclosed by cracks, and coalescence of cracks; outlines in summary.json"
            .to_owned();
    let rows = pieces.iter().map(|piece| piece_row(run, piece));
    for (mut cells, cycles) in rows.chain(junctions.iter().map(|junction| junction_row(run, junction))) {
        if let Some(load) = load {
            cells.insert(4, cycles.map_or_else(String::new, |cycles| tonnage(cycles * load / 1e6)));
        }
        table.row(cells);
    }
    Some(table)
}

/// The cells of a piece, and its load cycles.
fn piece_row(run: &RunFolder, piece: &PieceSummary) -> (Vec<String>, Option<f64>) {
    let enclosed = Enclosed::of(run, piece);
    let places = piece.outline_mm.iter().map(|corner| corner[0]);
    let (left, right) =
        places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let top = piece.outline_mm.iter().map(|corner| -corner[1]).fold(f64::INFINITY, f64::min);
    let (name, top) = match piece.kind {
        PieceKind::Spall => ("spall", "0".to_owned()),
        _ => ("detached piece", fixed(top, 2)),
    };
    let cells = vec![
        name.to_owned(),
        enclosed.by(),
        piece.step.to_string(),
        grouped(enclosed.cycles),
        format!("{} to {}", fixed(left, 2), fixed(right, 2)),
        format!("{top} to {}", fixed(enclosed.depth, 2)),
        significant(piece.area_mm2),
        piece.outline_mm.len().to_string(),
    ];
    (cells, Some(enclosed.cycles))
}

/// The cells of a junction, and its load cycles; without these from the start.
fn junction_row(run: &RunFolder, junction: &JunctionSummary) -> (Vec<String>, Option<f64>) {
    let rows = run.growth.iter().filter(|row| {
        row.crack == junction.crack && row.stop == Some(RunStop::NoTipGrows(TipStop::Coalescence))
    });
    let step = rows.map(|row| row.step).max();
    let cycles = step.map(|step| {
        let after = run.growth.iter().find(|row| row.step == step + 1);
        after.map_or(run.summary.load_cycles, |row| row.load_cycles)
    });
    let cells = vec![
        format!("joins crack {}", junction.onto),
        format!("crack {}, {} end", junction.crack, junction.end.word()),
        step.map_or_else(|| "from the start".to_owned(), |step| step.to_string()),
        cycles.map_or_else(String::new, grouped),
        fixed(junction.x_mm, 2),
        fixed(-junction.y_mm, 2),
        String::new(),
        String::new(),
    ];
    (cells, cycles)
}
