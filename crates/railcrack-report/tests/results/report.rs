//! The report of a run: its numbers against the tables, its structure, its safety against texts,
//! its size.

use super::support::{
    HALF_WIDTH, SMALL, Scratch, Size, case, case_of, case_text, info, mixed_case, mixed_info, mixed_step,
    record_steps,
};
use miniz_oxide::inflate::decompress_to_vec_zlib;
use railcrack_report::{Block, FolderKind, Page, Pages, Section, rebuild_report};
use railcrack_run::{Existing, Recorder};
use serde_json::Value;
use std::fs;
use std::path::Path;

pub fn run(folder: &Path, size: Size) {
    let mut recorder = Recorder::start(folder, case(), info(), Existing::Refuse, &Pages).unwrap();
    record_steps(&mut recorder, size, 0, size.increments + 1).unwrap();
    recorder.finish().unwrap();
}

/// A run of two wheels.
fn mix(folder: &Path, size: Size) {
    let mut recorder = Recorder::start(folder, mixed_case(), mixed_info(), Existing::Refuse, &Pages).unwrap();
    for n in 0..=size.increments {
        let (record, state) = mixed_step(size, n);
        recorder.record(&record, &state).unwrap();
    }
    recorder.finish().unwrap();
}

pub fn report(folder: &Path) -> String {
    fs::read_to_string(folder.join("report.html")).unwrap()
}

/// The data of the explorer.
fn data(page: &str) -> Value {
    data_of(page, "run-data")
}

pub fn data_of(page: &str, id: &str) -> Value {
    let (_, after) = page.split_once(&format!("<script type=\"application/json\" id=\"{id}\">")).unwrap();
    serde_json::from_str(after.split_once("</script>").unwrap().0).unwrap()
}

/// Rows of a table as maps would have them: the fields of `columns`.
pub fn rows(folder: &Path, file: &str, columns: &[&str]) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join(file)).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let places: Vec<usize> =
        columns.iter().map(|column| header.iter().position(|name| name == column).unwrap()).collect();
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        places.iter().map(|&place| fields[place].to_owned()).collect()
    };
    lines.map(row).collect()
}

pub fn unpacked(value: &Value) -> Vec<u8> {
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let (mut bits, mut count, mut bytes) = (0u32, 0, Vec::new());
    for letter in value.as_str().unwrap().bytes().filter(|&letter| letter != b'=') {
        bits = bits << 6 | letters.iter().position(|&l| l == letter).unwrap() as u32;
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    decompress_to_vec_zlib(&bytes).unwrap()
}

pub fn singles(value: &Value) -> Vec<f64> {
    let bytes = unpacked(value);
    bytes.chunks_exact(4).map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap()))).collect()
}

/// Quantised values in rows of `row`, kept as differences from the level above (in the first row
/// from the one before), and half a level.
pub fn quantised(value: &Value, row: usize) -> (Vec<f64>, f64) {
    let (low, step) = (value["low"].as_f64().unwrap(), value["step"].as_f64().unwrap());
    let bytes = unpacked(&value["data"]);
    let count = bytes.len() / 2;
    let mut levels: Vec<u16> = Vec::with_capacity(count);
    for i in 0..count {
        let folded = u16::from(bytes[i]) | u16::from(bytes[count + i]) << 8;
        let difference = (folded >> 1) ^ (folded & 1).wrapping_neg();
        let near = i.checked_sub(if i < row { 1 } else { row }).map_or(0, |place| levels[place]);
        levels.push(near.wrapping_add(difference));
    }
    (levels.iter().map(|&level| low + step * f64::from(level)).collect(), 0.5 * step)
}

/// Levels of K over a passage, and of the numbers of the faces, less one.
const K_STEPS: f64 = 65535.0;
const FACE_STEPS: f64 = 255.0;

/// Packed values, and half a level, which must be that of `steps` levels over what is `wanted`.
fn checked(value: &Value, row: usize, steps: f64, wanted: &[f64]) -> (Vec<f64>, f64) {
    let (values, half) = quantised(value, row);
    let [low, high] = [f64::min, f64::max].map(|end| wanted.iter().copied().reduce(end).unwrap());
    let want = 0.5 * (high - low) / steps;
    assert!((half - want).abs() <= 1e-5 * want + 1e-15, "half a level is {half}, not {want}");
    (values, half)
}

/// The numbers of column `i` of `rows`.
fn column(rows: &[&Vec<String>], i: usize) -> Vec<f64> {
    rows.iter().map(|row| row[i].parse().unwrap()).collect()
}

/// Of a mix every wheel has its own half-width, positions, K and faces: the second one has half as
/// many positions, and faces in the first and the last step.
#[test]
fn the_second_wheel_of_a_mix_has_its_own_passage() {
    let scratch = Scratch::new("report-mix");
    let size = Size { cracks: 2, ..SMALL };
    mix(scratch.path(), size);
    let page = report(scratch.path());
    let data = data(&page);
    let wheels = data["wheels"].as_array().unwrap();
    let names: Vec<&str> = wheels.iter().map(|wheel| wheel["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["heavy", "light"]);
    assert_eq!([&wheels[0]["share"], &wheels[1]["share"]], [0.25, 0.75]);
    assert_eq!([&wheels[0]["half_width"], &wheels[1]["half_width"]], [HALF_WIDTH, 5.0]);
    let positions = (size.positions - 1) / 2 + 1;
    assert_eq!(wheels[1]["xc_over_a"].as_array().unwrap().len(), positions);
    let steps = data["steps"].as_array().unwrap();
    let columns = ["step", "passage", "crack", "wheel", "position", "kii_mpa_sqrt_m", "xc_over_a"];
    let table = rows(scratch.path(), "sif.csv", &columns);
    let mut compared = [0, 0];
    let passages = [(1, 0), (1, 1), (2, 0), (2, 1)];
    for (step, (crack, wheel)) in (0..5).flat_map(|step| passages.map(|passage| (step, passage))) {
        // Of the stabilised passage.
        let own = [step, 2, crack, wheel + 1].map(|number| number.to_string());
        let of_tip: Vec<&Vec<String>> = table.iter().filter(|row| row[..4] == own).collect();
        let packed = &steps[step]["wheels"][wheel]["histories"][crack - 1]["kii"];
        let (kii, half) = checked(packed, of_tip.len(), K_STEPS, &column(&of_tip, 5));
        assert_eq!(kii.len(), of_tip.len());
        for row in of_tip {
            let place = row[4].parse::<usize>().unwrap() - 1;
            let [want, x] = [5, 6].map(|i| row[i].parse::<f64>().unwrap());
            let tolerance = 1.001 * half + 1e-6 * want.abs();
            assert!((kii[place] - want).abs() <= tolerance, "{row:?}: {}", kii[place]);
            assert!((wheels[wheel]["xc_over_a"][place].as_f64().unwrap() - x).abs() <= 1e-5, "{row:?}");
            compared[wheel] += 1;
        }
    }
    assert_eq!(compared, [2 * 5 * size.positions, 2 * 5 * positions]);
    let columns = ["step", "wheel", "crack", "s22_mpa"];
    let table = rows(scratch.path(), "faces.csv", &columns);
    assert_eq!(table.len(), 2 * size.face_points * (5 * size.positions + 2 * positions));
    for step in 0..5 {
        let faces = &steps[step]["wheels"][1]["faces"];
        assert_eq!(faces.is_null(), ![0, 4].contains(&step), "step {step}");
        for (crack, of_crack) in faces.as_array().into_iter().flatten().enumerate() {
            let own = [step.to_string(), "2".to_owned(), (crack + 1).to_string()];
            let own_rows: Vec<&Vec<String>> = table.iter().filter(|row| row[..3] == own).collect();
            let want = column(&own_rows, 3).into_iter().map(|s22| -s22).collect::<Vec<_>>();
            let (pressure, half) = checked(&of_crack["pressure"], positions, FACE_STEPS, &want);
            assert_eq!(pressure.len(), want.len());
            for (i, want) in want.iter().enumerate() {
                let at = (i % size.face_points) * positions + i / size.face_points;
                assert!((pressure[at] - want).abs() <= 1.001 * half, "step {step}, row {i}: {want}");
            }
        }
    }
    assert!(page.contains("<select id=\"of-mix\">"));
    // From the tables alone it is the same page.
    fs::remove_file(scratch.path().join("report.html")).unwrap();
    rebuild_report(scratch.path()).unwrap();
    assert!(report(scratch.path()) == page);
}

#[test]
fn histories_and_faces_are_those_of_the_tables() {
    let short = Size { cracks: 2, ..SMALL };
    // So many face states that the page has every other position, and the last one.
    let long = Size { increments: 4, positions: 126, face_points: 260, cracks: 1 };
    for (size, stride) in [(short, 1), (long, 2)] {
        let scratch = Scratch::new("report-numbers");
        run(scratch.path(), size);
        let data = data(&report(scratch.path()));
        assert_eq!(data["wheels"][0]["face_stride"], stride);
        let steps = data["steps"].as_array().unwrap();
        assert_eq!(steps.len(), 5);
        histories_are_those_of_the_table(scratch.path(), steps, size);
        faces_are_those_of_the_table(scratch.path(), steps, size, stride);
    }
}

fn histories_are_those_of_the_table(folder: &Path, steps: &[Value], size: Size) {
    let columns = ["step", "passage", "crack", "position", "ki_mpa_sqrt_m", "kii_mpa_sqrt_m"];
    let table = rows(folder, "sif.csv", &columns);
    let mut compared = 0;
    for (step, crack) in (0..5).flat_map(|step| (1..=size.cracks).map(move |crack| (step, crack))) {
        // Of the stabilised passage.
        let own = [step, 2, crack].map(|number| number.to_string());
        let of_tip: Vec<&Vec<String>> = table.iter().filter(|row| row[..3] == own).collect();
        let tip = &steps[step]["wheels"][0]["histories"][crack - 1];
        for (name, i) in [("ki", 4), ("kii", 5)] {
            let (values, half) = checked(&tip[name], size.positions, K_STEPS, &column(&of_tip, i));
            assert_eq!(values.len(), size.positions);
            for row in &of_tip {
                let want = row[i].parse::<f64>().unwrap();
                let found = values[row[3].parse::<usize>().unwrap() - 1];
                assert!((found - want).abs() <= 1.001 * half + 1e-6 * want.abs(), "{row:?}: {found}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 2 * size.cracks * 5 * size.positions);
}

fn faces_are_those_of_the_table(folder: &Path, steps: &[Value], size: Size, stride: usize) {
    let columns = ["step", "crack", "position", "opening_mm", "slip_mm", "s22_mpa", "status"];
    let table = rows(folder, "faces.csv", &columns);
    assert_eq!(table.len(), 5 * size.positions * size.cracks * size.face_points);
    let last = size.positions - 1;
    let kept = last.div_ceil(stride) + 1;
    let mut compared = 0;
    for (step, crack) in (0..5).flat_map(|step| (1..=size.cracks).map(move |crack| (step, crack))) {
        let faces = &steps[step]["wheels"][0]["faces"][crack - 1];
        let own = [step, crack].map(|number| number.to_string());
        let of_crack: Vec<&Vec<String>> = table.iter().filter(|row| row[..2] == own).collect();
        let packed = [("opening", 1.0), ("slip", 1.0), ("pressure", -1.0)].iter().enumerate();
        let packed: Vec<(Vec<f64>, Vec<f64>, f64)> = packed
            .map(|(c, (name, sign))| {
                let wanted: Vec<f64> = column(&of_crack, 3 + c).iter().map(|value| sign * value).collect();
                let (values, half) = checked(&faces[name], kept, FACE_STEPS, &wanted);
                assert_eq!(values.len(), kept * size.face_points);
                (wanted, values, half)
            })
            .collect();
        let status = unpacked(&faces["status"]);
        assert_eq!(status.len(), kept * size.face_points);
        for (i, row) in of_crack.iter().enumerate() {
            // Rows go by position and point, the page by point and position.
            let (position, point) = (i / size.face_points, i % size.face_points);
            assert_eq!(row[2], (position + 1).to_string());
            if !position.is_multiple_of(stride) && position != last {
                continue;
            }
            let at = point * kept + position.div_ceil(stride);
            for (wanted, values, half) in &packed {
                let (want, found) = (wanted[i], values[at]);
                assert!((found - want).abs() <= half * 1.001 + 1e-15, "{row:?}: {found}");
            }
            assert_eq!(["open", "stick", "slip"][usize::from(status[at])], row[6]);
            compared += 1;
        }
    }
    assert_eq!(compared, 5 * kept * size.cracks * size.face_points);
}

#[test]
fn fields_are_those_of_the_first_and_the_last_step_that_have_files() {
    let scratch = Scratch::new("report-fields");
    run(scratch.path(), SMALL);
    let fields = data_of(&report(scratch.path()), "field-data");
    let steps = fields["steps"].as_array().unwrap();
    assert_eq!(steps.iter().map(|step| step["step"].as_u64().unwrap()).collect::<Vec<_>>(), [0, 4]);
    let last = &steps[1];
    let values = |value: &Value| quantised(value, usize::MAX).0;
    for (name, want) in [("x", [0.0, -1.0, 1.0]), ("y", [0.0, -1.0, -1.0])] {
        let (found, half) = quantised(&last[name], usize::MAX);
        for (found, want) in found.iter().zip(want) {
            assert!((found - want).abs() <= 1.001 * half, "{name}: {found}, not {want}");
        }
    }
    // A triangle: points 0, 1, 2, 2 as differences 0, 1, 1, 0, of which twice the size is kept, low
    // bytes first.
    assert_eq!(unpacked(&last["corners"]), [0, 2, 2, 0, 0, 0, 0, 0]);
    let snapshot = &last["snapshots"][1];
    assert_eq!(snapshot["position"], 21);
    assert_eq!((values(&snapshot["ux"]), values(&snapshot["uy"])), (vec![0.004; 3], vec![2.0; 3]));
    // σ_xx alone is the stress of von Mises.
    assert!((values(&snapshot["stress"])[0] - 100.0 / 3.0).abs() < 1e-12);
    // A file that is no field is not taken for one, a field that is damaged is named.
    fs::write(scratch.path().join("fields/mine.vtu"), "x").unwrap();
    rebuild_report(scratch.path()).unwrap();
    fs::write(scratch.path().join("fields/step-0004-position-0011.vtu"), "x").unwrap();
    let refused = rebuild_report(scratch.path()).unwrap_err().to_string();
    assert!(refused.contains("step-0004-position-0011.vtu"), "{refused}");
}

#[test]
fn the_first_lines_say_cycles_tonnes_direction_stop_and_warnings() {
    let scratch = Scratch::new("report-first");
    let with_traffic = case_of(&case_text("[traffic]\naxle_load_t = 20.0\n[growth]\nsteps = 4"));
    let mut recorder =
        Recorder::start(scratch.path(), with_traffic, info(), Existing::Refuse, &Pages).unwrap();
    record_steps(&mut recorder, SMALL, 0, 5).unwrap();
    recorder.finish().unwrap();
    let page = report(scratch.path());
    let result = page.split_once("id=\"result\"").unwrap().1.split_once("</section>").unwrap().0;
    // 4.1e5 (1 − 0.9⁴) cycles of 20 t.
    for words in [
        "140\u{a0}999 load cycles (2.82 million gross tonnes at 20 t per axle)",
        "<dt>Load cycles</dt><dd>140\u{a0}999",
        "<dt>Million gross tonnes</dt><dd>2.82",
        "<dt>Direction</dt><dd>downward",
        "<dt>Ended by</dt><dd>steps done<small>after step 4 of 4",
        "Near ties of the direction criterion: the path is sensitive to this choice (docs/warnings.md#near-tie). Step 1: ",
        "<th scope=\"row\">6.80</th>",
        "faces no initial gap, unilateral contact, Coulomb friction; stick and slip are reset at the start of each growth step; friction 0.5",
    ] {
        assert!(result.contains(words), "no \"{words}\" in {result}");
    }
    // Without an axle load, no tonnes: they are never derived.
    let other = Scratch::new("report-no-traffic");
    let without = case_of(&case_text(""));
    let mut recorder = Recorder::start(other.path(), without, info(), Existing::Refuse, &Pages).unwrap();
    record_steps(&mut recorder, SMALL, 0, 5).unwrap();
    recorder.finish().unwrap();
    assert!(report(other.path()).contains("<dt>Million gross tonnes</dt><dd>not given"));
}

/// The report of a run without a step, of a case with these sections at its end.
fn report_of(name: &str, more: &str) -> String {
    let scratch = Scratch::new(name);
    let case = case_of(&case_text(more));
    Recorder::start(scratch.path(), case, info(), Existing::Refuse, &Pages).unwrap().finish().unwrap();
    report(scratch.path())
}

#[test]
fn the_size_of_a_block_is_among_the_assumptions() {
    let block = "[rail]\nboundary = \"block\"\nwidth_mm = 250.0\ndepth_mm = 150.0\n\
                 bottom = \"clamped\"\nsides = \"rollers\"";
    let page = report_of("report-block", block);
    assert!(
        page.contains("boundary block of 250 by 150 mm, bottom clamped, sides rollers;"),
        "no size of the block"
    );
    let half_plane = report_of("report-half-plane", "");
    assert!(half_plane.contains("boundary half-plane;"));
}

#[test]
fn every_direction_criterion_has_its_words() {
    for (name, words) in [
        ("max-rate", "direction largest growth rate of the kink;"),
        ("max-rate-unclipped", "direction largest growth rate of the kink, negative k<sub>1</sub> counted;"),
        ("max-delta-k1", "direction largest range of k<sub>1</sub>;"),
        ("max-k1", "direction largest k<sub>1</sub>;"),
    ] {
        let page = report_of(&format!("report-{name}"), &format!("[growth]\ndirection = \"{name}\""));
        assert!(page.contains(words), "{name}: no \"{words}\"");
    }
}

/// Names of elements in the order of their tags, scripts and styles left out; every tag must be
/// closed.
fn check_structure(page: &str) {
    let mut open: Vec<String> = Vec::new();
    let mut rest = page.strip_prefix("<!DOCTYPE html>").unwrap();
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        let (tag, after) = rest.split_once('>').unwrap();
        rest = after;
        let name: String =
            tag.trim_start_matches('/').chars().take_while(char::is_ascii_alphanumeric).collect();
        assert!(!name.is_empty(), "a bare < before \"{}\"", &tag[..tag.len().min(40)]);
        if tag.ends_with('/') {
            // An element of a picture without content.
            continue;
        }
        if tag.starts_with('/') {
            assert_eq!(open.pop().as_deref(), Some(name.as_str()));
        } else if !["meta", "link", "input", "img", "wbr"].contains(&name.as_str()) {
            if ["script", "style"].contains(&name.as_str()) {
                let (_, after) = rest.split_once(&format!("</{name}>")).unwrap();
                rest = after;
            } else {
                open.push(name);
            }
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

#[test]
fn elements_are_closed_and_names_are_unique() {
    let scratch = Scratch::new("report-structure");
    run(scratch.path(), Size { cracks: 3, ..SMALL });
    let page = report(scratch.path());
    check_structure(&page);
    let markup: String =
        page.split("<script").map(|part| part.split_once("</script>").map_or(part, |p| p.1)).collect();
    let mut names: Vec<&str> =
        markup.split(" id=\"").skip(1).map(|part| part.split('"').next().unwrap()).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert!(names.len() == count && count > 15, "{names:?}");
    assert!(!markup.contains("src=\"http") && !markup.contains("href=\"http"), "a reference to the network");
}

#[test]
fn texts_of_the_case_are_harmless() {
    let scratch = Scratch::new("report-texts");
    let evil = "</script><script>alert('1')</script><!-- \"> & <img src=x onerror=alert(1)>";
    let mut info = info();
    info.title = evil.to_owned();
    let files = railcrack_run::CaseFiles {
        toml: format!("# {evil}\n{}", case_text("").replace("\"synthetic\"", &format!("'''{evil}'''"))),
        ..case()
    };
    let mut recorder = Recorder::start(scratch.path(), files, info, Existing::Refuse, &Pages).unwrap();
    record_steps(&mut recorder, SMALL, 0, 5).unwrap();
    recorder.finish().unwrap();
    let page = report(scratch.path());
    assert!(
        !page.contains("<script>alert") && !page.contains("<img src=x"),
        "the title is part of the page's code"
    );
    assert!(page.contains("&lt;/script&gt;&lt;script&gt;alert(&#39;1&#39;)"));
    check_structure(&page);
    data(&page);
    let page = Page {
        title: evil.to_owned(),
        sections: vec![Section {
            id: evil.to_owned(),
            heading: evil.to_owned(),
            blocks: vec![Block::Verbatim(evil.to_owned())],
        }],
        ..Page::default()
    };
    check_structure(&page.html());
}

#[test]
fn twenty_five_steps_stay_below_five_megabytes() {
    let scratch = Scratch::new("report-size");
    run(scratch.path(), Size { increments: 25, positions: 241, face_points: 120, cracks: 1 });
    let size = fs::metadata(scratch.path().join("report.html")).unwrap().len();
    assert!(size < 5_000_000, "{size} bytes");
    let network = Scratch::new("report-size-network");
    run(network.path(), Size { increments: 25, positions: 241, face_points: 60, cracks: 9 });
    let size = fs::metadata(network.path().join("report.html")).unwrap().len();
    assert!(size < 5_000_000, "{size} bytes");
    let page = report(network.path());
    assert!(page.contains("faces are shown at one in 4 wheel positions"), "what is left out is said");
}

#[test]
fn rebuilt_from_the_folder_alone_it_is_the_same_whatever_the_times() {
    let scratch = Scratch::new("report-rebuild");
    run(scratch.path(), SMALL);
    let before = report(scratch.path());
    for file in ["report.html", "checkpoint.bin"] {
        fs::remove_file(scratch.path().join(file)).unwrap();
    }
    fs::remove_dir_all(scratch.path().join("plots")).unwrap();
    let path = scratch.path().join("summary.json");
    let mut summary: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    summary["wall_s"] = 1234.5.into();
    summary["peak_memory_mb"] = 1.0.into();
    fs::write(&path, summary.to_string()).unwrap();
    assert_eq!(rebuild_report(scratch.path()).unwrap(), FolderKind::Run);
    assert_eq!(before, report(scratch.path()));
    assert!(scratch.path().join("plots/ki.svg").is_file());
}

#[test]
fn what_is_left_out_is_the_same_in_one_go_resumed_and_rebuilt() {
    // Too many face states: of the first run positions are left out, of the second, which has few
    // of them, steps.
    let first = Size { increments: 25, positions: 125, face_points: 330, cracks: 1 };
    let second = Size { positions: 61, face_points: 330, cracks: 2, ..first };
    for (size, says) in [
        (first, "faces are shown at one in 2 wheel positions"),
        (second, "the passage explorer shows 14 of 26 growth steps"),
    ] {
        let (whole, cut) = (Scratch::new("report-whole"), Scratch::new("report-cut"));
        run(whole.path(), size);
        let page = report(whole.path());
        assert!(page.contains(says), "{says}");
        let mut recorder = Recorder::start(cut.path(), case(), info(), Existing::Refuse, &Pages).unwrap();
        record_steps(&mut recorder, size, 0, 22).unwrap();
        let (mut recorder, state) = Recorder::resume(cut.path(), case(), info(), &Pages).unwrap();
        record_steps(&mut recorder, size, state.unwrap().step, 26).unwrap();
        recorder.finish().unwrap();
        assert!(report(cut.path()) == page, "resumed: {says}");
        rebuild_report(whole.path()).unwrap();
        assert!(report(whole.path()) == page, "rebuilt: {says}");
    }
}

#[test]
fn an_unfinished_run_is_shown_as_such() {
    let scratch = Scratch::new("report-unfinished");
    let mut recorder = Recorder::start(scratch.path(), case(), info(), Existing::Refuse, &Pages).unwrap();
    recorder.finish().unwrap();
    assert!(report(scratch.path()).contains("No step is finished yet."));
    record_steps(&mut recorder, SMALL, 0, 2).unwrap();
    recorder.finish().unwrap();
    assert!(report(scratch.path()).contains("The run has not ended: step 1 is the last finished one."));
    check_structure(&report(scratch.path()));
}

#[test]
fn bad_folders_are_named() {
    let scratch = Scratch::new("report-bad");
    let refused = rebuild_report(scratch.path()).unwrap_err().to_string();
    assert!(
        refused.contains("holds no results to report on") && refused.contains("summary.json"),
        "{refused}"
    );
    run(scratch.path(), SMALL);
    let table = |file: &str, from: &str, to: &str| {
        let path = scratch.path().join(file);
        let good = fs::read_to_string(&path).unwrap();
        assert!(good.contains(from), "{file}");
        fs::write(&path, good.replacen(from, to, 1)).unwrap();
        let refused = rebuild_report(scratch.path()).unwrap_err().to_string();
        fs::write(&path, good).unwrap();
        refused
    };
    for (file, from, to, says) in [
        ("growth.csv", "delta_keq_mpa_sqrt_m,", "other,", "no column delta_keq_mpa_sqrt_m"),
        ("faces.csv", ",stick\n", ",stuck\n", "status is \"stuck\", not open, stick or slip"),
        ("sif.csv", "-6.0,", "x,", "xc_over_a is \"x\", not a finite number"),
        ("summary.json", "\"engine\"", "\"motor\"", "missing field `engine`"),
        ("case.toml", "friction", "fraction", "fraction"),
    ] {
        let refused = table(file, from, to);
        assert!(refused.contains(says) && refused.contains(file), "{file}: {refused}");
    }
    rebuild_report(scratch.path()).unwrap();
}
