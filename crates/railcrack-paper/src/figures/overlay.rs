//! Digitised curves of a figure of the paper, shown with the computed ones, and their distance.

use super::charts::{Quantity, TableCurve};
use super::tables::{DIGITISED, FigureTable};
use crate::error::PaperError;
use crate::figure::{FIGURES, Figure, parse_figures};
use railcrack_report::put;
use railcrack_run::OutputError;
use railcrack_run::disk::inner_folder;
use std::path::{Path, PathBuf};

/// The folder of digitised curves in that of the results.
const OVERLAYS: &str = "overlays";
/// The columns of `overlays.csv`.
pub(crate) const OVERLAY_COLUMNS: &str = "figure,curve,crack,quantity,setup,points,largest,mean";

/// Curves of one figure, read off the paper by a user: `fig18.csv` with the columns `curve` (as in
/// `figures/fig18.csv`; `profile` for Fig. 21), `crack` where there are several, and the
/// coordinates of that table.
pub struct Overlay {
    figure: &'static Figure,
    text: String,
}

/// Distance of a computed curve from a digitised one, at the digitised points.
pub(crate) struct Distance {
    pub(crate) curve: String,
    pub(crate) crack: String,
    pub(crate) quantity: Quantity,
    pub(crate) setup: String,
    pub(crate) points: usize,
    /// MPa√m; mm for paths; MPa for a profile.
    pub(crate) largest: f64,
    pub(crate) mean: f64,
}

impl Overlay {
    /// Reads the file at `path`, whose name says which figure it is of: `fig18.csv`.
    ///
    /// Errors: no such file; a name that is no figure with results; columns, curves or numbers that
    /// the figure does not have.
    pub fn read(path: &Path) -> Result<Self, PaperError> {
        let refused = |says: String| PaperError::Overlay { path: path.to_path_buf(), says };
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let numbers = parse_figures(&[stem]).map_err(|unknown| refused(unknown.to_string()))?;
        let figure = FIGURES.iter().find(|figure| numbers.contains(&figure.number));
        let figure = figure.ok_or_else(|| refused("unknown figure".to_owned()))?;
        let text = std::fs::read_to_string(path).map_err(OutputError::io("read", path))?;
        let table = FigureTable::parse(&text).map_err(refused)?;
        let quantities = Quantity::of(figure);
        let mut count = 0;
        for quantity in quantities {
            let curves =
                quantity.curves(&table).map_err(|value| refused(format!("`{value}` is not a number")))?;
            for curve in curves.unwrap_or_default() {
                let known = figure.curves;
                if !known.is_empty() && !known.contains(&curve.name.as_str()) {
                    return Err(refused(format!(
                        "`{}` is not a curve of Fig. {}: must be one of {}",
                        curve.name,
                        figure.number,
                        known.join(", ")
                    )));
                }
                count += curve.points.len();
            }
        }
        if count == 0 {
            let columns = quantities.iter().map(|quantity| quantity.columns().join(" and "));
            let columns = columns.collect::<Vec<_>>().join(", or ");
            return Err(refused(format!("no points: the columns must be curve, {columns}")));
        }
        Ok(Self { figure, text })
    }

    /// The number of its figure.
    pub fn figure(&self) -> u8 {
        self.figure.number
    }

    /// Its path in `folder`.
    fn place(folder: &Path, figure: &Figure) -> PathBuf {
        folder.join(OVERLAYS).join(format!("{}.csv", figure.file_stem()))
    }

    /// Stores it in `folder`, so that pages can be rebuilt.
    ///
    /// Errors: the system refuses.
    pub(crate) fn keep(&self, folder: &Path) -> Result<(), OutputError> {
        inner_folder(folder, OVERLAYS)?;
        put(&Self::place(folder, self.figure), &self.text)
    }
}

/// Deletes the digitised curves in `folder`.
///
/// Errors: the system refuses.
pub(crate) fn forget_overlays(folder: &Path) -> Result<(), OutputError> {
    let path = folder.join(OVERLAYS);
    match std::fs::remove_dir_all(&path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(OutputError::io("remove", &path)(error))
        }
        _ => Ok(()),
    }
}

/// The digitised curves of `figure` that `folder` keeps; none where there are none.
///
/// Errors: the file is damaged; the system refuses.
pub(crate) fn kept(
    folder: &Path,
    figure: &Figure,
    quantity: Quantity,
) -> Result<Vec<TableCurve>, OutputError> {
    let path = Overlay::place(folder, figure);
    if !path.is_file() {
        return Ok(Vec::new());
    }
    let text = std::fs::read_to_string(&path).map_err(OutputError::io("read", &path))?;
    let damaged = |reason| OutputError::damaged(&path, reason);
    let table = FigureTable::parse(&text).map_err(damaged)?;
    let curves = quantity.curves(&table).map_err(|text| damaged(format!("\"{text}\" is not a number")))?;
    let digitised = |curve: TableCurve| TableCurve {
        setup: DIGITISED.to_owned(),
        // A figure with one crack has no crack numbers.
        crack: if curve.crack.is_empty() && quantity != Quantity::Profile { "1".into() } else { curve.crack },
        ..curve
    };
    Ok(curves.unwrap_or_default().into_iter().map(digitised).collect())
}

/// The distance of each curve of `ours` from the one of `digitised` with its name and crack.
pub(crate) fn distances(quantity: Quantity, ours: &[TableCurve], digitised: &[TableCurve]) -> Vec<Distance> {
    let mut distances = Vec::new();
    for given in digitised {
        for curve in ours.iter().filter(|curve| curve.name == given.name && curve.crack == given.crack) {
            let off: Vec<f64> =
                given.points.iter().filter_map(|&point| distance(quantity, &curve.points, point)).collect();
            if off.is_empty() {
                continue;
            }
            distances.push(Distance {
                curve: given.name.clone(),
                crack: given.crack.clone(),
                quantity,
                setup: curve.setup.clone(),
                points: off.len(),
                largest: off.iter().copied().fold(0.0, f64::max),
                mean: off.iter().sum::<f64>() / off.len() as f64,
            });
        }
    }
    distances
}

/// Distance of `point` from the curve through `points`: of a path to its nearest place, else of the
/// value at the same position or depth; none beyond the ends of the curve.
fn distance(quantity: Quantity, points: &[[f64; 2]], [x, y]: [f64; 2]) -> Option<f64> {
    let between = |at: usize, value: usize, place: f64| {
        points.windows(2).find_map(|pair| {
            let (a, b) = (pair[0][at], pair[1][at]);
            let inside = (a.min(b)..=a.max(b)).contains(&place) && a != b;
            inside.then(|| pair[0][value] + (place - a) / (b - a) * (pair[1][value] - pair[0][value]))
        })
    };
    match quantity {
        Quantity::Ki | Quantity::Kii => Some((y - between(0, 1, x)?).abs()),
        Quantity::Profile => Some((x - between(1, 0, y)?).abs()),
        Quantity::Paths => {
            let to = |pair: &[[f64; 2]]| {
                let way = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
                let from = [x - pair[0][0], y - pair[0][1]];
                let length = way[0] * way[0] + way[1] * way[1];
                let share = if length > 0.0 { (from[0] * way[0] + from[1] * way[1]) / length } else { 0.0 };
                let share = share.clamp(0.0, 1.0);
                (from[0] - share * way[0]).hypot(from[1] - share * way[1])
            };
            points.windows(2).map(to).reduce(f64::min)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(setup: &str, points: &[[f64; 2]]) -> TableCurve {
        TableCurve { setup: setup.into(), name: "a".into(), crack: "1".into(), points: points.to_vec() }
    }

    #[test]
    fn distances_are_those_of_plane_geometry() {
        let path = curve("ours", &[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]]);
        let digitised = curve(DIGITISED, &[[1.0, 1.0], [5.0, 2.0], [7.0, 7.0]]);
        let of =
            |quantity| distances(quantity, std::slice::from_ref(&path), std::slice::from_ref(&digitised));
        let on_paths = of(Quantity::Paths).remove(0);
        // One point next to the first part, one next to the second, one beyond the end: 3, 4, 5.
        assert_eq!((on_paths.points, on_paths.largest), (3, 5.0));
        assert!((on_paths.mean - 7.0 / 3.0).abs() < 1e-12, "{}", on_paths.mean);
        // Of K the value at the same position counts: one of the points is within the curve.
        let of_k = of(Quantity::Ki).remove(0);
        assert_eq!((of_k.points, of_k.largest), (1, 1.0));
        // Of a profile the value at the same depth: two depths are within the curve.
        let of_profile = of(Quantity::Profile).remove(0);
        assert_eq!((of_profile.points, of_profile.largest), (2, 3.0));
    }

    #[test]
    fn other_curves_are_not_compared() {
        let other = TableCurve { name: "b".into(), ..curve("ours", &[[0.0, 0.0], [1.0, 0.0]]) };
        assert!(distances(Quantity::Ki, &[other], &[curve(DIGITISED, &[[0.5, 1.0]])]).is_empty());
    }
}
