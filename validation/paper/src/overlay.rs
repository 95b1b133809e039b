//! Digitised curves of a figure of the paper, drawn with the computed ones, and their distance.

use crate::error::PaperError;
use crate::figures::{Curves, DIGITISED, FigureCurve, Quantity};
use crate::tables::{Figure, Paper};
use railcrack_run::OutputError;
use railcrack_run::csv::line_fields;
use std::path::{Path, PathBuf};

/// The columns of `overlays.csv`.
pub const OVERLAY_COLUMNS: &str = "figure,curve,crack,quantity,setup,points,largest,mean";

/// Curves of one figure, read off the paper by a user: `fig18.csv` with the columns `curve` (as in
/// `figures/fig18.csv`; `profile` for Fig. 21), `crack` where there are several, and the
/// coordinates of that table.
pub struct Overlay {
    path: PathBuf,
    /// The number of its figure.
    pub figure: u8,
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Overlay {
    /// Reads the file at `path`, whose name says which of `figures` it belongs to: `fig18.csv`.
    ///
    /// Errors: no such file; a name that is not among the recomputed figures; rows that are not as
    /// long as the header.
    pub fn read(paper: &Paper, path: &Path, figures: &[u8]) -> Result<Self, PaperError> {
        let refused = |reason: String| PaperError::Table { path: path.to_path_buf(), reason };
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let numbers = paper.figures_called(&[stem]).map_err(|unknown| refused(unknown.to_string()))?;
        let figure = numbers.into_iter().find(|number| figures.contains(number));
        let figure = figure.ok_or_else(|| refused("its figure is not among the recomputed ones".into()))?;
        let text = std::fs::read_to_string(path).map_err(OutputError::io("read", path))?;
        let mut rows = text.lines().filter(|line| !line.starts_with('#')).map(line_fields);
        let header = rows.next().unwrap_or_default();
        let rows: Vec<Vec<String>> = rows.collect();
        if let Some(row) = rows.iter().find(|row| row.len() != header.len()) {
            return Err(refused(format!(
                "`{}` has {} fields, not {}",
                row.join(","),
                row.len(),
                header.len()
            )));
        }
        Ok(Self { path: path.to_path_buf(), figure, header, rows })
    }

    /// Adds its curves to those of `figure`, and returns their distances as rows of `overlays.csv`.
    ///
    /// Errors: a curve or number that the figure does not have; no points.
    pub fn add_to(&self, figure: &Figure, curves: &mut Curves) -> Result<String, PaperError> {
        let mut rows = String::new();
        let mut count = 0;
        for (quantity, ours) in curves.iter_mut() {
            for given in self.curves(figure, *quantity)? {
                count += given.points.len();
                for curve in ours.iter().filter(|curve| curve.is_same_crack(&given)) {
                    let off: Vec<f64> =
                        given.points.iter().filter_map(|p| distance(*quantity, &curve.points, *p)).collect();
                    let FigureCurve { name, crack, setup, .. } = curve;
                    let largest = off.iter().copied().fold(0.0, f64::max);
                    let mean = off.iter().sum::<f64>() / off.len() as f64;
                    let what = format!("{},{name},{crack},{}", figure.number, quantity.columns()[1]);
                    rows.push_str(&format!("{what},\"{setup}\",{},{largest:?},{mean:?}\n", off.len()));
                }
                ours.push(given);
            }
        }
        if count == 0 {
            let columns = Quantity::of(figure.kind).iter().map(|quantity| quantity.columns().join(" and "));
            let columns = columns.collect::<Vec<_>>().join(", or ");
            return Err(self.refused(format!("no points: the columns must be curve, {columns}")));
        }
        Ok(rows)
    }

    /// Its curves of `quantity`; none where it has no such columns.
    fn curves(&self, figure: &Figure, quantity: Quantity) -> Result<Vec<FigureCurve>, PaperError> {
        let column = |name: &str| self.header.iter().position(|column| column == name);
        let [Some(x), Some(y)] = quantity.columns().map(column) else { return Ok(Vec::new()) };
        let (curve, crack) = (column("curve").or(column("profile")), column("crack"));
        let mut curves: Vec<FigureCurve> = Vec::new();
        // K_I and K_II have positions of their own, and a row lacks one of them.
        for row in self.rows.iter().filter(|row| !row[x].is_empty() && !row[y].is_empty()) {
            let number = |text: &str| {
                let number = text.parse().ok().filter(|number: &f64| number.is_finite());
                number.ok_or_else(|| self.refused(format!("`{text}` is not a number")))
            };
            let point = [number(&row[x])?, number(&row[y])?];
            let name = curve.map_or("", |at| &row[at]);
            if quantity != Quantity::Profile && !figure.curves.iter().any(|known| known == name) {
                let (number, known) = (figure.number, figure.curves.join(", "));
                return Err(
                    self.refused(format!("`{name}` is not a curve of Fig. {number}: must be one of {known}"))
                );
            }
            let crack = crack.map_or(Ok(1.0), |at| number(&row[at]))? as usize;
            let (setup, name) = (DIGITISED.to_owned(), name.to_owned());
            let next = FigureCurve { setup, name, crack, points: vec![point] };
            match curves.iter_mut().find(|known| known.is_same_crack(&next)) {
                Some(known) => known.points.push(point),
                None => curves.push(next),
            }
        }
        Ok(curves)
    }

    fn refused(&self, reason: String) -> PaperError {
        PaperError::Table { path: self.path.clone(), reason }
    }
}

/// Distance of a point from the curve through `points`: of a path to its nearest place, else of the
/// value at the same position or depth; none beyond the ends of the curve.
fn distance(quantity: Quantity, points: &[[f64; 2]], [x, y]: [f64; 2]) -> Option<f64> {
    let between = |at: usize, value: usize, place: f64| {
        points.windows(2).find_map(|pair| {
            let (a, b) = (pair[0][at], pair[1][at]);
            let is_inside = (a.min(b)..=a.max(b)).contains(&place) && a != b;
            is_inside.then(|| pair[0][value] + (place - a) / (b - a) * (pair[1][value] - pair[0][value]))
        })
    };
    match quantity {
        Quantity::Ki | Quantity::Kii => Some((y - between(0, 1, x)?).abs()),
        Quantity::Profile => Some((x - between(1, 0, y)?).abs()),
        Quantity::Paths => {
            let to = |pair: &[[f64; 2]]| {
                let part = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
                let from = [x - pair[0][0], y - pair[0][1]];
                let length = part[0] * part[0] + part[1] * part[1];
                let share = if length > 0.0 { (from[0] * part[0] + from[1] * part[1]) / length } else { 0.0 };
                let share = share.clamp(0.0, 1.0);
                (from[0] - share * part[0]).hypot(from[1] - share * part[1])
            };
            points.windows(2).map(to).reduce(f64::min)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_plane_geometry() {
        let path = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]];
        let of = |quantity| [[1.0, 1.0], [5.0, 2.0], [7.0, 7.0]].map(|p| distance(quantity, &path, p));
        // One point next to the first part, one next to the second, one beyond the end: 3, 4, 5.
        assert_eq!(of(Quantity::Paths), [Some(1.0), Some(1.0), Some(5.0)]);
        // Of K the value at the same position counts, of a profile that at the same depth.
        assert_eq!(of(Quantity::Ki), [Some(1.0), None, None]);
        assert_eq!(of(Quantity::Profile), [Some(3.0), Some(1.0), None]);
    }

    /// A curve moved up by half a unit is half a unit away from itself.
    #[test]
    fn a_digitised_curve_is_measured() {
        let paper = Paper::read().unwrap();
        let path =
            std::env::temp_dir().join(format!("paper-of-2014-{}", std::process::id())).join("fig13.csv");
        let read = |text: &str, figures: &[u8]| {
            crate::files::write(&path, text).unwrap();
            Overlay::read(&paper, &path, figures)
        };
        let figure = &paper.figures[0];
        let points = vec![[0.0, 1.0], [1.0, 2.0], [2.0, 5.0]];
        let ours = |setup: &str| FigureCurve {
            setup: setup.into(),
            name: "fig13".into(),
            crack: 1,
            points: points.clone(),
        };
        let mut curves =
            vec![(Quantity::Ki, vec![]), (Quantity::Kii, vec![ours("half-plane, along"), ours("c")])];
        let overlay = read("curve,xc_over_a,kii_mpa_sqrt_m\nfig13,0.5,2.0\nfig13,2.0,5.5\n", &[13]).unwrap();
        let rows = overlay.add_to(figure, &mut curves).unwrap();
        let row = |setup: &str| format!("13,fig13,1,kii_mpa_sqrt_m,\"{setup}\",2,0.5,0.5\n");
        assert_eq!(rows, row("half-plane, along") + &row("c"));
        assert_eq!(curves[1].1.len(), 3);
        assert!(crate::charts::sheet(&paper, figure, &curves).svg().contains("digitised"));

        // Curves and figures that are not there are named.
        let refused = |text: &str, figures: &[u8]| {
            let refused = read(text, figures).and_then(|overlay| overlay.add_to(figure, &mut curves.clone()));
            refused.unwrap_err().to_string()
        };
        let other = refused("curve,xc_over_a,kii_mpa_sqrt_m\nnine,0,1\n", &[13]);
        assert!(other.contains("`nine` is not a curve of Fig. 13: must be one of fig13"), "{other}");
        assert!(refused("curve,x\nfig13,0\n", &[13]).contains("no points"));
        assert!(
            refused("curve,xc_over_a,kii_mpa_sqrt_m\nfig13,0,x\n", &[13]).contains("`x` is not a number")
        );
        assert!(refused("curve,x\nfig13,0\n", &[14]).contains("not among the recomputed"));
    }
}
