//! The SVG files of the figures: the main set-ups, both bodies and both directions of travel.

use crate::figures::{Curves, DIGITISED, FigureCurve, Quantity, cracks};
use crate::results::Results;
use crate::tables::{Figure, Kind, MAIN, Paper};
use railcrack_report::{
    Chart, ChartAspect, ChartAxis, ChartRange, ChartSheet, Curve, CurveColour, CurveDots, CurveLook,
    CurveWidth, LegendEntry, SheetLegend,
};

/// Points of an initial crack: all are straight.
const INITIAL_POINTS: usize = 2;
/// Cracks of a run in the block whose K leaves the other curves readable.
const FEW_CRACKS: usize = 2;
/// Colours of things without order.
const COLOURS: usize = 9;
/// Length over depth of paths that are shown one below the other.
const LONG: f64 = 5.0;

/// The sheet of `figure` from its `curves`, digitised ones included.
pub fn sheet(paper: &Paper, figure: &Figure, curves: &Curves) -> ChartSheet {
    let drawing = |(quantity, curves): &(Quantity, Vec<FigureCurve>)| Drawing {
        paper,
        figure,
        quantity: *quantity,
        curves: curves.clone(),
    };
    let drawings: Vec<Drawing> = curves.iter().map(drawing).collect();
    let rows = match figure.kind {
        Kind::Sif => drawings.iter().map(Drawing::sif_row).collect(),
        Kind::Paths => {
            let panels: Vec<Chart> = drawings.iter().flat_map(Drawing::path_panels).collect();
            // Long rows of cracks need the whole width for their growth to be visible.
            let columns = if panels.iter().any(is_long) { 1 } else { 2 };
            panels.chunks(columns).map(<[Chart]>::to_vec).collect()
        }
        Kind::Profile => drawings.iter().map(|drawing| vec![drawing.profiles()]).collect(),
    };
    let legend = match figure.kind {
        Kind::Sif => {
            SheetLegend::Names(LegendEntry::solid_and_dashed(["half-plane", "block, bottom clamped"]).into())
        }
        _ => SheetLegend::default(),
    };
    ChartSheet {
        title: format!("Trollé et al. (2014), Fig. {}, recomputed", figure.number),
        subtitle: figure.title.clone(),
        rows,
        legend,
    }
}

/// One quantity of a figure, to be drawn.
struct Drawing<'a> {
    paper: &'a Paper,
    figure: &'a Figure,
    quantity: Quantity,
    curves: Vec<FigureCurve>,
}

impl Drawing<'_> {
    /// K for cracks that lean along the travel and against it: half-plane solid, block dashed.
    fn sif_row(&self) -> Vec<Chart> {
        let column = |way: &str| {
            let [half_plane, block] = ["half-plane", "block"].map(|body| format!("{body}, {way}"));
            let is_shown = |curve: &FigureCurve| {
                curve.setup == DIGITISED
                    || curve.setup == half_plane
                    || curve.setup == block && cracks(&self.curves, &curve.name) <= FEW_CRACKS
            };
            let look = |(own, curve): (&FigureCurve, Curve)| match own.setup == block {
                true => curve.with_look(CurveLook::Dashed),
                false => curve,
            };
            let curves = self.drawn(&is_shown).map(look).collect();
            let heading = match self.quantity {
                Quantity::Ki => format!("Cracks lean {way} the travel"),
                _ => String::new(),
            };
            Chart { heading, curves, ..self.empty() }
        };
        ["along", "against"].map(column).into()
    }

    /// The paths in each main set-up that has any.
    fn path_panels(&self) -> Vec<Chart> {
        let panels = self.paper.setups[..MAIN]
            .iter()
            .filter(|setup| self.curves.iter().any(|curve| curve.setup == setup.name));
        panels.map(|setup| self.path_panel(&setup.name)).collect()
    }

    fn path_panel(&self, setup: &str) -> Chart {
        let names = &self.figure.curves;
        let is_crowded = names.iter().map(|name| cracks(&self.curves, name)).sum::<usize>() > COLOURS;
        let is_shown = |curve: &FigureCurve| curve.setup == setup || curve.setup == DIGITISED;
        let dotted = |(own, curve): (&FigureCurve, Curve)| {
            let curve = curve.with_dots(CurveDots::AllBut(0..INITIAL_POINTS));
            match names.iter().position(|name| *name == own.name) {
                // Among more paths than colours all paths of a curve of the paper have the same
                // colour, and those of the first curve are visible below the others.
                Some(place) if is_crowded && own.setup != DIGITISED => Curve {
                    name: self.paper.legend(self.figure, &own.name).to_owned(),
                    width: if place == 0 { CurveWidth::Wide } else { CurveWidth::Usual },
                    ..curve.with_colour(CurveColour::Category(place))
                },
                _ => curve,
            }
        };
        let paths: Vec<Curve> = self.drawn(&is_shown).map(dotted).collect();
        let initial = |path: &Curve| {
            let points = path.points.iter().take(INITIAL_POINTS).copied().collect();
            Curve::line("initial crack", points).with_colour(CurveColour::Ink).with_width(CurveWidth::Wide)
        };
        let ours = paths.iter().filter(|path| path.look != CurveLook::Dots);
        let initial: Vec<Curve> = ours.map(initial).collect();
        let body = setup.split(',').next().unwrap_or(setup);
        let side = if setup.ends_with("against") { "left" } else { "right" };
        Chart {
            heading: format!("{body}: wheel rolls to the {side}"),
            curves: paths.into_iter().chain(initial).collect(),
            ..self.empty()
        }
    }

    /// The readings of Fig. 21 solid, rolled rails dashed.
    fn profiles(&self) -> Chart {
        let look = |(own, curve): (&FigureCurve, Curve)| match own.name.starts_with("rolled") {
            true => curve.with_look(CurveLook::Dashed),
            false => curve,
        };
        Chart { curves: self.drawn(&|_| true).map(look).collect(), ..self.empty() }
    }

    /// The curves that `is_shown`: name and crack give words and colour, the same in every set-up.
    fn drawn<'a>(
        &'a self,
        is_shown: &'a dyn Fn(&FigureCurve) -> bool,
    ) -> impl Iterator<Item = (&'a FigureCurve, Curve)> + 'a {
        let mut different: Vec<&FigureCurve> = Vec::new();
        for curve in &self.curves {
            if !different.iter().any(|other| other.is_same_crack(curve)) {
                different.push(curve);
            }
        }
        self.curves.iter().filter(|curve| is_shown(curve)).map(move |curve| {
            let place = different.iter().position(|other| other.is_same_crack(curve)).unwrap_or(0);
            let mut words = self.paper.legend(self.figure, &curve.name).to_owned();
            if cracks(&self.curves, &curve.name) > 1 {
                words.push_str(&format!(", crack {}", curve.crack));
            }
            if curve.setup == DIGITISED {
                words.push_str(", digitised");
            }
            let look = if curve.setup == DIGITISED { CurveLook::Dots } else { CurveLook::Line };
            let line = Curve::line(&words, curve.points.clone()).with_look(look);
            (curve, line.with_colour(CurveColour::of(place, different.len())))
        })
    }

    /// The chart without curves.
    fn empty(&self) -> Chart {
        let sif = |symbol: &str| {
            let x = ChartAxis::linear("x_{c}/a, along the travel", "").over(ChartRange::Tight);
            [x, ChartAxis::linear(symbol, "MPa√m").over(ChartRange::AroundZero)]
        };
        let [x, y] = match self.quantity {
            Quantity::Ki => sif("K_{I}"),
            Quantity::Kii => sif("K_{II}"),
            Quantity::Paths => [ChartAxis::linear("x", "mm"), ChartAxis::depth()],
            Quantity::Profile => {
                [ChartAxis::linear("σ_{xx}", "MPa"), ChartAxis::depth().over(ChartRange::Tight)]
            }
        };
        let aspect = if self.quantity == Quantity::Paths { ChartAspect::Equal } else { ChartAspect::Free };
        Chart { x, y, aspect, ..Chart::default() }
    }
}

/// Whether a panel of paths is much longer than deep.
fn is_long(panel: &Chart) -> bool {
    let extent = |c: usize| {
        let values = panel.curves.iter().flat_map(|curve| &curve.points).map(|point| point[c]);
        let wider = |[low, high]: [f64; 2], value: f64| [low.min(value), high.max(value)];
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], wider);
        high - low
    };
    extent(0) > LONG * extent(1)
}

/// K of both engines on the case of Fig. 13, and their difference in per cent of the peak; none if
/// a run is missing.
pub fn engines(paper: &Paper, results: &Results) -> Option<ChartSheet> {
    let sif = |setup| Some(&results.setup(paper, setup)?.crack("fig13")?.sif);
    let (first, second) = (sif("half-plane, along")?, sif("half-plane xfem, along")?);
    let difference = second.minus(first);
    let chart = |y: ChartAxis, heading: &str, curves: Vec<Curve>| Chart {
        heading: heading.to_owned(),
        x: ChartAxis::linear("x_{c}/a", "").over(ChartRange::Tight),
        y: y.over(ChartRange::AroundZero),
        curves,
        ..Chart::default()
    };
    let row = |(symbol, of, column): (&str, [&[f64]; 2], usize), headings: [&str; 2]| {
        let [first_k, second_k] = of;
        let over = |x: &[f64], k: &[f64]| x.iter().zip(k).map(|(&x, &k)| [x, k]).collect();
        let off = difference.iter().map(|d| [d[0], 100.0 * d[column] / first.peak()]).collect();
        let both = vec![
            Curve::line("distributed dislocations", over(&first.position, first_k))
                .with_width(CurveWidth::Wide),
            Curve::line("finite elements", over(&second.position, second_k)).with_look(CurveLook::Dashed),
        ];
        let off = Curve::line("", off).with_colour(CurveColour::Category(2));
        let axis = ChartAxis::linear(&format!("Difference of {symbol}"), "% of the peak");
        vec![
            chart(ChartAxis::linear(symbol, "MPa√m"), headings[0], both),
            chart(axis, headings[1], vec![off]),
        ]
    };
    Some(ChartSheet {
        title: "Two engines on the case of Fig. 13".to_owned(),
        subtitle: "K over the stabilised passage, half-plane".to_owned(),
        rows: vec![
            row(
                ("K_{I}", [&first.ki, &second.ki], 1),
                ["Both engines", "Finite elements minus dislocations"],
            ),
            row(("K_{II}", [&first.kii, &second.kii], 2), ["", ""]),
        ],
        ..ChartSheet::default()
    })
}
