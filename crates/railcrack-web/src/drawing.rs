//! Charts of a page as its script describes them, drawn as those of every report.

use railcrack_report::{Chart, ChartAspect, ChartAxis, ChartRange, Curve, CurveColour, CurveDots, CurveLook};
use serde_json::Value;

/// The figure of the chart in `text`: its `kind` (`ki`, `kii`, `depth`, `depth-mgt` or `path`), and
/// `curves` with a name, points, and the number of their colour; null for a dashed one behind the
/// others. `None` where the text is none of these.
pub(crate) fn figure(text: &[u8]) -> Option<String> {
    let value: Value = serde_json::from_slice(text).ok()?;
    let curves: Option<Vec<Curve>> = value.get("curves")?.as_array()?.iter().map(curve).collect();
    let curves = curves?;
    let of = |id: &str, caption: &str, x: ChartAxis, y: ChartAxis| {
        let (id, caption) = (format!("what-if-{id}"), caption.to_owned());
        Chart { id, caption, x, y, curves: curves.clone(), ..Chart::default() }
    };
    let history = |id: &str, symbol: &str| {
        let x = ChartAxis::linear("x_{c}/a", "").over(ChartRange::Tight);
        let y = ChartAxis::linear(symbol, "MPa√m").over(ChartRange::AroundZero);
        of(id, &format!("{symbol} over the first passage."), x, y)
    };
    let lives = |traffic: &str| {
        let y = ChartAxis::depth().over(ChartRange::AroundZero);
        dotted(of("depth", "Depth over traffic.", ChartAxis::linear(traffic, ""), y))
    };
    let chart = match value.get("kind")?.as_str()? {
        "ki" => history("ki", "K_{I}"),
        "kii" => history("kii", "K_{II}"),
        "depth" => lives("Load cycles"),
        "depth-mgt" => lives("Million gross tonnes"),
        "path" => Chart {
            aspect: ChartAspect::Equal,
            ..of("path", "Path, to scale.", ChartAxis::linear("x", "mm"), ChartAxis::depth())
        },
        _ => return None,
    };
    Some(chart.figure())
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
        let text = br#"{"kind":"depth-mgt",
            "curves":[{"name":"first","colour":null,"points":[[0,1],[2,3]]},{"name":"now","colour":0,"points":[[0,1],[1,4]]}]}"#;
        let figure = figure(text).unwrap();
        assert_eq!(figure.matches("class=\"curve\"").count(), 2, "{figure}");
        assert_eq!(figure.matches("<circle").count(), 2 + 1, "dots of the life, and in the legend: {figure}");
        assert!(figure.contains("data-name=\"now\"") && figure.contains("stroke-dasharray=\"6 4\""));
        assert!(super::figure(b"{}").is_none());
    }
}
