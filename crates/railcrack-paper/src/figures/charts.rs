//! Charts of the quantities in the table of a figure.

use super::tables::{DIGITISED, FigureTable};
use crate::figure::{Figure, Kind};
use railcrack_report::{Chart, ChartAspect, ChartAxis, ChartRange, Curve, CurveColour, CurveLook};

/// A quantity in the table of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// K_I over the passage.
    Ki,
    /// K_II over the passage.
    Kii,
    /// Crack paths.
    Paths,
    /// Stress by depth.
    Profile,
}

/// A curve in the table of a figure.
pub(crate) struct TableCurve {
    /// The set-up; empty for the profiles of Fig. 21.
    pub(crate) setup: String,
    /// Name of the curve or profile.
    pub(crate) name: String,
    /// Number of the crack; empty for a profile.
    pub(crate) crack: String,
    /// Points in the units of the axes.
    pub(crate) points: Vec<[f64; 2]>,
}

impl Quantity {
    /// The quantities that `figure` shows.
    pub(crate) fn of(figure: &Figure) -> &'static [Self] {
        match figure.kind {
            Kind::Sif => &[Self::Ki, Self::Kii],
            Kind::Paths => &[Self::Paths],
            Kind::Profile => &[Self::Profile],
        }
    }

    /// The columns of x and y.
    pub(crate) fn columns(self) -> [&'static str; 2] {
        self.names().2
    }

    /// Its symbol.
    pub(crate) fn symbol(self) -> &'static str {
        match self {
            Self::Ki => "K_{I}",
            Self::Kii => "K_{II}",
            Self::Paths => "path",
            Self::Profile => "σ_{xx}",
        }
    }

    /// The unit of a distance between two curves of it.
    pub(crate) fn unit_of_distance(self) -> &'static str {
        match self {
            Self::Ki | Self::Kii => "MPa\u{221a}m",
            Self::Paths => "mm",
            Self::Profile => "MPa",
        }
    }

    /// Name of its chart, its words, and the columns of x and y.
    fn names(self) -> (&'static str, &'static str, [&'static str; 2]) {
        match self {
            Self::Ki => ("ki", "K_{I} over the passage", ["xc_over_a", "ki_mpa_sqrt_m"]),
            Self::Kii => ("kii", "K_{II} over the passage", ["xc_over_a", "kii_mpa_sqrt_m"]),
            Self::Paths => ("paths", "Crack paths to scale", ["x_mm", "depth_mm"]),
            Self::Profile => ("profile", "Stress by depth", ["sxx_mpa", "depth_mm"]),
        }
    }

    /// Its curves in `table`; none where the table has no such columns.
    ///
    /// Errors: the text of a value that is no finite number.
    pub(crate) fn curves(self, table: &FigureTable) -> Result<Option<Vec<TableCurve>>, String> {
        let [Some(x), Some(y)] = self.names().2.map(|name| table.column(name)) else { return Ok(None) };
        let texts = ["setup", "curve", "crack", "profile"].map(|name| table.column(name));
        let mut curves: Vec<TableCurve> = Vec::new();
        // Digitised K_I and K_II have positions of their own, and a row lacks one of them.
        for row in table.rows().filter(|row| !row[x].is_empty() && !row[y].is_empty()) {
            let number = |at: usize| {
                let value = row[at].parse().ok().filter(|value: &f64| value.is_finite());
                value.ok_or_else(|| row[at].clone())
            };
            let point = [number(x)?, number(y)?];
            let [setup, curve, crack, profile] =
                texts.map(|place| place.map_or("", |place| row[place].as_str()));
            let name = if curve.is_empty() { profile } else { curve };
            let same =
                |last: &&mut TableCurve| last.setup == setup && last.name == name && last.crack == crack;
            match curves.last_mut().filter(same) {
                Some(curve) => curve.points.push(point),
                None => curves.push(TableCurve {
                    setup: setup.to_owned(),
                    name: name.to_owned(),
                    crack: crack.to_owned(),
                    points: vec![point],
                }),
            }
        }
        Ok(Some(curves))
    }

    /// An empty chart of it.
    pub(super) fn chart(self, figure: &Figure) -> Chart {
        let sif = |symbol: &str| {
            let x = ChartAxis::linear("x_{c}/a, along the travel", "").over(ChartRange::Tight);
            [x, ChartAxis::linear(symbol, "MPa√m").over(ChartRange::AroundZero)]
        };
        let [x, y] = match self {
            Self::Ki => sif("K_{I}"),
            Self::Kii => sif("K_{II}"),
            Self::Paths => [ChartAxis::linear("x", "mm"), ChartAxis::depth()],
            Self::Profile => [ChartAxis::linear("σ_{xx}", "MPa"), ChartAxis::depth().over(ChartRange::Tight)],
        };
        let (id, words, _) = self.names();
        Chart {
            id: format!("{}-{id}", figure.file_stem()),
            caption: format!("Fig. {}: {}.", figure.number, words),
            x,
            y,
            aspect: if self == Self::Paths { ChartAspect::Equal } else { ChartAspect::Free },
            ..Chart::default()
        }
    }
}

/// How many cracks the curve `name` has among `curves`.
pub(super) fn cracks(curves: &[TableCurve], name: &str) -> usize {
    let mut cracks: Vec<&str> =
        curves.iter().filter(|curve| curve.name == name).map(|curve| curve.crack.as_str()).collect();
    cracks.sort_unstable();
    cracks.dedup();
    cracks.len()
}

/// The `curves` of `figure` that `is_shown`, with their places among all: name and crack give words
/// and colour, the same in every set-up.
pub(super) fn drawn<'a>(
    figure: &'a Figure,
    curves: &'a [TableCurve],
    is_shown: impl Fn(&TableCurve) -> bool + 'a,
) -> impl Iterator<Item = (&'a TableCurve, Curve)> + 'a {
    let mut seen: Vec<(&str, &str)> = Vec::new();
    for curve in curves {
        let own = (curve.name.as_str(), curve.crack.as_str());
        if !seen.contains(&own) {
            seen.push(own);
        }
    }
    curves.iter().filter(move |curve| is_shown(curve)).map(move |curve| {
        let own = (curve.name.as_str(), curve.crack.as_str());
        let place = seen.iter().position(|other| *other == own).unwrap_or(0);
        let mut words = figure.words(&curve.name).to_owned();
        if cracks(curves, &curve.name) > 1 {
            words.push_str(&format!(", crack {}", curve.crack));
        }
        if curve.setup == DIGITISED {
            words.push_str(", digitised");
        }
        let colour = CurveColour::of(place, seen.len());
        let line = Curve::line(&words, curve.points.clone()).with_colour(colour);
        (curve, if curve.setup == DIGITISED { line.with_look(CurveLook::Dots) } else { line })
    })
}

/// The chart of `quantity` with the `curves` of all set-ups, each completed by `styled` for the
/// page.
pub(crate) fn page_chart(
    figure: &Figure,
    quantity: Quantity,
    curves: &[TableCurve],
    styled: impl Fn(&TableCurve, Curve) -> Curve,
) -> Chart {
    let all = drawn(figure, curves, |_| true).map(|(table, curve)| styled(table, curve));
    Chart { curves: all.collect(), ..quantity.chart(figure) }
}
