//! Life and depth over the increment of whole kinks.

use railcrack_report::{
    Chart, ChartAxis, ChartSheet, Curve, CurveColour, CurveDots, CurveLook, LegendEntry, SheetLegend,
};

/// Lives and tips by case, turning and increment, computed with `tools/path_limit.py`.
const TABLE: &str = include_str!("../../path/increments.csv");
/// The cases of the paper in it, with the words of the legend.
const CASES: [(&str, &str); 3] = [
    ("Table 1", "Table 1"),
    ("\"Table 1, wheel 0.1\"", "wheel–rail friction 0.1"),
    ("\"Table 1, wheel 0.4\"", "wheel–rail friction 0.4"),
];
/// Places of increment, axles and depth behind `case,turning,` in the table.
const INCREMENT: usize = 0;
const AXLES: usize = 1;
const DEPTH: usize = 3;

/// Life to a length of 11 mm and depth of the tip there over the increment: whole kinks with dots,
/// a path that turns over 0.5 mm dashed.
pub(crate) fn increments() -> ChartSheet {
    let chart = |heading: &str, y: ChartAxis, place: usize, scale: f64| {
        let curves = CASES.iter().enumerate().flat_map(|(i, (case, words))| {
            let colour = CurveColour::of(i, CASES.len());
            let line = move |turning: &str| {
                let points = values(case, turning, place).into_iter();
                Curve::line(words, points.map(|[x, y]| [100.0 * x, scale * y]).collect()).with_colour(colour)
            };
            [line("kink").with_dots(CurveDots::All), line("smooth").with_look(CurveLook::Dashed)]
        });
        Chart {
            heading: heading.to_owned(),
            x: ChartAxis::logarithmic("Increment", "% of the length"),
            y,
            curves: curves.collect(),
            ..Chart::default()
        }
    };
    let looks = LegendEntry::solid_and_dashed(["whole kinks", "turning length 0.5 mm"]);
    ChartSheet {
        title: "Life and path over the increment".to_owned(),
        subtitle: "Crack of Table 1 from 6 to 11 mm, half-plane, along the travel".to_owned(),
        rows: vec![vec![
            chart("Life", ChartAxis::logarithmic("Life", "million axles"), AXLES, 1e-6),
            chart("Tip at 11 mm", ChartAxis::depth(), DEPTH, 1.0),
        ]],
        legend: SheetLegend::Names(looks.into()),
    }
}

/// The increments of the rows of `case` with this turning, each with the value at `place`; without
/// those whose path did not reach the length.
fn values(case: &str, turning: &str, place: usize) -> Vec<[f64; 2]> {
    let start = format!("{case},{turning},");
    let rows = TABLE.lines().filter_map(|line| line.strip_prefix(&start));
    rows.filter_map(|row| {
        let cells: Vec<&str> = row.split(',').collect();
        let point = [cells.get(INCREMENT)?.parse().ok()?, cells.get(place)?.parse().ok()?];
        point.iter().all(|value: &f64| value.is_finite()).then_some(point)
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_has_its_rows() {
        for (case, _) in CASES {
            for (turning, least) in [("kink", 6), ("smooth", 7)] {
                let lives = values(case, turning, AXLES);
                assert!(lives.len() >= least, "{case}, {turning}: {lives:?}");
                assert!(lives.iter().all(|life| life[1] > 1e5), "{lives:?}");
                assert!(values(case, turning, DEPTH).iter().all(|tip| (1.0..7.0).contains(&tip[1])));
            }
        }
        // Whole kinks of half a per cent live 36 times as long as those of 4 %.
        let lives = values("Table 1", "kink", AXLES);
        let at = |increment: f64| lives.iter().find(|life| life[0] == increment).unwrap()[1];
        assert!(at(0.005) > 30.0 * at(0.04));
    }

    #[test]
    fn the_picture_in_docs_is_this_one() {
        let drawn = increments().svg();
        let kept = include_str!("../../../../docs/figures/increments.svg");
        if drawn != kept {
            let path = std::env::temp_dir().join("increments.svg");
            std::fs::write(&path, drawn).unwrap();
            panic!("docs/figures/increments.svg is not {}", path.display());
        }
    }
}
