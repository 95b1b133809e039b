//! Charts of a page as its script describes them, drawn as those of every report.

use railcrack_report::{
    Chart, ChartAspect, ChartAxis, ChartRange, ChartScale, Curve, CurveColour, CurveDots, CurveLook,
};
use serde_json::Value;

/// The figure of the chart in `text`: its `id` and `caption`, the titles `x` and `y` of its axes, its
/// `kind` (`history`, `depth` or `path`), and `curves` with a name, points, and the number of their
/// colour; null for a dashed one behind the others. `None` where the text is none of these.
pub(crate) fn figure(text: &[u8]) -> Option<String> {
    let value: Value = serde_json::from_slice(text).ok()?;
    let word = |name: &str| Some(value.get(name)?.as_str()?.to_owned());
    let axis = |title: String| ChartAxis { label: title, ..ChartAxis::default() };
    let (x, y) = (axis(word("x")?), axis(word("y")?));
    let curves: Option<Vec<Curve>> = value.get("curves")?.as_array()?.iter().map(curve).collect();
    let chart = Chart { id: word("id")?, caption: word("caption")?, curves: curves?, ..Chart::default() };
    let depth = ChartAxis { scale: ChartScale::Depth, ..y.clone() };
    Some(
        match word("kind")?.as_str() {
            "depth" => Chart { x, y: depth.over(ChartRange::AroundZero), ..dotted(chart) },
            "path" => Chart { x, y: depth, aspect: ChartAspect::Equal, ..chart },
            _ => Chart { x: x.over(ChartRange::Tight), y: y.over(ChartRange::AroundZero), ..chart },
        }
        .figure(),
    )
}

/// The chart with a dot at each step of the lives in colour.
fn dotted(mut chart: Chart) -> Chart {
    for curve in chart.curves.iter_mut().filter(|curve| curve.look == CurveLook::Line) {
        curve.dots = CurveDots::All;
    }
    chart
}

fn curve(value: &Value) -> Option<Curve> {
    let number = |point: &Value, c: usize| point.get(c)?.as_f64();
    let points = value.get("points")?.as_array()?.iter();
    let points = points.map(|point| Some([number(point, 0)?, number(point, 1)?])).collect::<Option<_>>()?;
    let curve = Curve::line(value.get("name")?.as_str()?, points);
    Some(match value.get("colour")?.as_u64() {
        Some(place) => curve.with_colour(CurveColour::Category(usize::try_from(place).ok()?)),
        None => curve.with_colour(CurveColour::Quiet).with_look(CurveLook::Dashed),
    })
}

#[cfg(test)]
mod tests {
    use super::figure;

    #[test]
    fn a_life_is_drawn_with_its_first_one_behind_it() {
        let text = br#"{"id":"d","caption":"Depth.","kind":"depth","x":"MGT","y":"Depth (mm)",
            "curves":[{"name":"first","colour":null,"points":[[0,1],[2,3]]},{"name":"now","colour":0,"points":[[0,1],[1,4]]}]}"#;
        let figure = figure(text).unwrap();
        assert_eq!(figure.matches("class=\"curve\"").count(), 2, "{figure}");
        assert_eq!(figure.matches("<circle").count(), 2 + 1, "dots of the life, and in the legend: {figure}");
        assert!(figure.contains("data-name=\"now\"") && figure.contains("stroke-dasharray=\"6 4\""));
        assert!(super::figure(b"{}").is_none());
    }
}
