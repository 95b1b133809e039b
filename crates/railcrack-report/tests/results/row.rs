//! The report of a row of many cracks: its map, what is left out of it, its colours.

use super::report::{data_of, quantised, report, rows, run, singles, unpacked};
use super::support::{SMALL, Scratch, Size};
use std::collections::BTreeSet;
use std::fs;

const ROW: Size = Size { cracks: 12, ..SMALL };

#[test]
fn the_map_has_the_states_of_the_table() {
    let scratch = Scratch::new("row-map");
    run(scratch.path(), ROW);
    let page = report(scratch.path());
    let data = data_of(&page, "row-data");
    assert_eq!(data["steps"], serde_json::json!([0, 1, 2, 3, 4]));
    assert_eq!(data["mouth"].as_array().unwrap().len(), 12);
    let columns = ["length_mm", "delta_keq_mpa_sqrt_m", "rate_mm_per_cycle", "tip_y_mm"];
    let table = rows(scratch.path(), "growth.csv", &columns);
    assert_eq!(table.len(), 5 * 12);
    for (c, (name, sign)) in
        [("length", 1.0), ("keq", 1.0), ("rate", 1.0), ("depth", -1.0)].iter().enumerate()
    {
        let values = singles(&data[name]);
        assert_eq!(values.len(), table.len());
        for (value, row) in values.iter().zip(&table) {
            let want = sign * row[c].parse::<f64>().unwrap();
            assert!((value - want).abs() <= 1e-6 * want.abs(), "{name}: {value} for {want}");
        }
    }
    // All grow, along paths that reach from the mouth further in every step.
    assert_eq!((&data["stops"], unpacked(&data["stop"])), (&serde_json::json!(["grows"]), vec![0; 60]));
    let ends = unpacked(&data["ends"]);
    assert_eq!(ends.len(), 2 * 2 * 60);
    // The first crack grows by the longest increments, the last one by the shortest.
    let longest = serde_json::json!([1, "longest, grew most, fastest at the end"]);
    assert_eq!((&data["named"][0], &data["named"][2]), (&longest, &serde_json::json!([12, "grew least"])));
    // The table of all cracks is folded, and sorts.
    let (lead, rest) = page.split_once("<section id=\"row\"").unwrap();
    assert!(!lead.contains("Every tip in the last finished step"));
    let (_, folded) = rest.split_once("<summary>Table of the 12 cracks</summary>").unwrap();
    let (folded, _) = folded.split_once("</details>").unwrap();
    assert!(folded.contains("<table class=\"sorts\"") && folded.matches("<tr>").count() == 1 + 12);
}

#[test]
fn k_is_given_near_each_crack_and_faces_of_the_named_ones() {
    let scratch = Scratch::new("row-windows");
    run(scratch.path(), ROW);
    let data = data_of(&report(scratch.path()), "run-data");
    let wheel = &data["wheels"][0];
    let windows = wheel["windows"].as_array().unwrap();
    let xc: Vec<f64> = wheel["xc_over_a"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    // As far before each mouth as the passage begins before the first one, as far after it as the
    // passage ends after the last one.
    let after = xc[40] - 11.0 * 0.5;
    for (crack, window) in windows.iter().enumerate() {
        let [from, to] = [0, 1].map(|end| window[end].as_u64().unwrap() as usize);
        let mouth = 0.5 * crack as f64;
        let inside = |x: f64| x - mouth > -6.0 - 1e-5 && x - mouth < after + 1e-5;
        assert!(inside(xc[from]) && inside(xc[to]), "crack {crack}: {from} to {to}");
        assert!(from == 0 || !inside(xc[from - 1]), "crack {crack}");
        assert!(to == 40 || !inside(xc[to + 1]), "crack {crack}");
    }
    let columns = ["step", "passage", "crack", "position", "kii_mpa_sqrt_m"];
    let mut compared = 0;
    for row in rows(scratch.path(), "sif.csv", &columns).iter().filter(|row| row[1] == "2") {
        let [step, crack, position] = [0, 2, 3].map(|i| row[i].parse::<usize>().unwrap());
        let [from, to] = [0, 1].map(|end| windows[crack - 1][end].as_u64().unwrap() as usize);
        if (from..=to).contains(&(position - 1)) {
            let (values, half) =
                quantised(&data["steps"][step]["wheels"][0]["histories"][crack - 1]["kii"], to + 1 - from);
            let want: f64 = row[4].parse().unwrap();
            let found = values[position - 1 - from];
            assert!((found - want).abs() <= 1.001 * half + 1e-12, "{row:?}: {found}");
            compared += 1;
        }
    }
    assert!(compared > 5 * 12 * 15, "{compared}");
    let named: Vec<u64> = data["named"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
    for step in 0..5 {
        let faces = &data["steps"][step]["wheels"][0]["faces"];
        if ![0, 4].contains(&step) {
            assert!(faces.is_null());
            continue;
        }
        let cracks: Vec<u64> =
            faces.as_array().unwrap().iter().map(|f| f["crack"].as_u64().unwrap()).collect();
        assert_eq!(cracks, named);
        for of_crack in faces.as_array().unwrap() {
            let crack = of_crack["crack"].as_u64().unwrap() as usize;
            let [from, to] = [0, 1].map(|end| windows[crack - 1][end].as_u64().unwrap() as usize);
            assert_eq!(of_crack["first"].as_u64().unwrap_or(0) as usize, from);
            let (pressure, half) = quantised(&of_crack["pressure"], to + 1 - from);
            assert_eq!(pressure.len(), (to + 1 - from) * ROW.face_points);
            let table = rows(scratch.path(), "faces.csv", &["step", "crack", "position", "s22_mpa"]);
            let table = table.iter().filter(|row| row[0] == step.to_string() && row[1] == crack.to_string());
            let table = table.filter(|row| (from..=to).contains(&(row[2].parse::<usize>().unwrap() - 1)));
            for (i, row) in table.enumerate() {
                let at = (i % ROW.face_points) * (to + 1 - from) + i / ROW.face_points;
                let want = -row[3].parse::<f64>().unwrap();
                assert!((pressure[at] - want).abs() <= 1.001 * half + 1e-12, "{row:?}: {}", pressure[at]);
            }
        }
    }
}

#[test]
fn colours_are_those_of_the_named_and_the_others_are_grey() {
    let scratch = Scratch::new("row-colours");
    run(scratch.path(), ROW);
    let page = report(scratch.path());
    for id in ["length-cycles", "rate-length", "depth-mgt"] {
        let (_, figure) = page.split_once(&format!("<figure class=\"chart\" id=\"{id}\"")).unwrap();
        let (_, drawing) = figure.split_once("<div class=\"drawing\">").unwrap();
        let svg = roxmltree::Document::parse(drawing.split_once("</div>").unwrap().0).unwrap();
        let curves: Vec<[&str; 4]> = svg
            .descendants()
            .filter(|node| node.attribute("class") == Some("curve"))
            .map(|curve| {
                let line = curve.first_element_child().unwrap();
                let of = |name: &str| curve.attribute(name).unwrap();
                let of_line = |name: &str| line.attribute(name).unwrap();
                [of("data-name"), of("data-note"), of_line("stroke"), of_line("stroke-width")]
            })
            .collect();
        assert_eq!(curves.len(), 12, "{id}");
        let (fine, named): (Vec<[&str; 4]>, Vec<[&str; 4]>) =
            curves.iter().copied().partition(|curve| curve[3] == "0.8");
        assert!(fine.iter().all(|curve| curve[2] == "var(--quiet)" && curve[0] == "other cracks"));
        let colours: BTreeSet<&str> = named.iter().map(|curve| curve[2]).collect();
        assert!(named.len() == 3 && colours.len() == 3, "{id}: {colours:?}");
        // Every crack is found by its number, whatever it is called.
        let notes: BTreeSet<&str> = curves.iter().map(|curve| curve[1]).collect();
        assert!(notes.len() == 12 && notes.contains("crack 7"), "{id}: {notes:?}");
    }
    let plot = |file: &str| fs::read_to_string(scratch.path().join("plots").join(file)).unwrap();
    assert!(plot("row.svg").contains("12 cracks in step 0 and in step 4"));
    assert!(plot("kii.svg").contains("other cracks") && plot("kii.svg").contains("crack 12: grew least"));
    assert!(plot("paths.svg").contains(">12<"));
}

#[test]
fn nine_cracks_have_colours_of_their_own_and_no_map() {
    let scratch = Scratch::new("row-of-nine");
    run(scratch.path(), Size { cracks: 9, ..SMALL });
    let page = report(scratch.path());
    assert!(!page.contains("row-data") && !page.contains("data-name=\"other cracks\""));
    assert!(!scratch.path().join("plots/row.svg").exists());
    assert!(page.contains("Every tip in the last finished step"));
}

#[test]
fn a_hundred_cracks_take_less_than_three_megabytes() {
    let scratch = Scratch::new("row-of-hundred");
    run(scratch.path(), Size { increments: 3, positions: 241, face_points: 24, cracks: 100 });
    let size = report(scratch.path()).len();
    assert!(size < 3_000_000, "{size} bytes");
    let paths = fs::read_to_string(scratch.path().join("plots/paths.svg")).unwrap();
    // Four strips of 25.
    assert_eq!(paths.matches("class=\"surface\"").count(), 4);
}
