//! The run folder: what a run leaves behind, and how it survives a kill.

use super::support::{SMALL, Scratch, Size, case, info, record_steps, step};
use railcrack::body::FacePoint;
use railcrack::growth::{GrowthState, StepRecord};
use railcrack_report::{Pages, rebuild_report};
use railcrack_run::csv::{FaceRow, SifRow, TipRow, column_names};
use railcrack_run::{Existing, OutputError, Recorder, ResidualRow, ResidualSummary, TablesOnly};
use railcrack_vtu::read_vtu;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The whole run in one go.
fn run_through(folder: &Path, size: Size) {
    let mut recorder = Recorder::start(folder, case(), info(), Existing::Refuse, &Pages).unwrap();
    record_steps(&mut recorder, size, 0, size.increments + 1).unwrap();
    recorder.finish().unwrap();
}

/// Takes the run up again and carries it to its end; the number of steps that were done before.
fn resume_to_the_end(folder: &Path, size: Size) -> usize {
    let (mut recorder, state) = Recorder::resume(folder, case(), info(), &Pages).unwrap();
    let done = state.as_ref().map_or(0, |state| state.step);
    if state.is_none_or(|state| state.ended.is_none()) {
        record_steps(&mut recorder, size, done, size.increments + 1).unwrap();
    }
    recorder.finish().unwrap();
    done
}

/// All files of a run as bytes, without those that hold wall times as they are.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for directory in ["", "plots", "inputs", "fields"].map(|name| folder.join(name)) {
        for entry in fs::read_dir(directory).into_iter().flatten() {
            let path = entry.unwrap().path();
            let name = path.strip_prefix(folder).unwrap().display().to_string();
            if path.is_file() && name != "checkpoint.bin" {
                let bytes = fs::read(&path).unwrap();
                files
                    .insert(name.clone(), if name == "summary.json" { without_times(&bytes) } else { bytes });
            }
        }
    }
    files
}

fn without_times(summary: &[u8]) -> Vec<u8> {
    let mut summary: serde_json::Value = serde_json::from_slice(summary).unwrap();
    for key in ["wall_s", "peak_memory_mb"] {
        summary[key] = 0.into();
    }
    summary["phases_s"]["output"] = 0.into();
    summary.to_string().into_bytes()
}

fn assert_same_run(one: &Path, other: &Path, when: &str) {
    let (one, other) = (content(one), content(other));
    assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>(), "{when}");
    for (name, bytes) in &one {
        assert!(*bytes == other[name], "{when}: {name} differs");
    }
}

/// Lines after the comments: the header and the rows.
fn table(folder: &Path, file: &str) -> Vec<String> {
    let text = fs::read_to_string(folder.join(file)).unwrap();
    assert!(text.starts_with("# railcrack "), "{file}: no version");
    assert!(text.ends_with('\n'));
    text.lines().skip_while(|line| line.starts_with('#')).map(str::to_owned).collect()
}

#[test]
fn columns_are_those_of_the_contract() {
    let wanted = [
        (
            column_names::<SifRow>(&[]).join(","),
            "step,passage,crack,tip,position,xc_mm,xc_over_a,ki_mpa_sqrt_m,kii_mpa_sqrt_m",
        ),
        (
            column_names::<TipRow>(&[]).join(","),
            "step,crack,tip,tip_x_mm,tip_y_mm,length_mm,ki_max_mpa_sqrt_m,delta_ki_mpa_sqrt_m,delta_kii_mpa_sqrt_m,delta_keq_mpa_sqrt_m,kink_angle_deg,rival_angle_deg,rival_ratio,increment_mm,rate_mm_per_cycle,load_cycles,stop,turn_deg,jump,load_cycles_error",
        ),
        (
            column_names::<FaceRow>(&[]).join(","),
            "step,passage,position,crack,segment,s_mm,opening_mm,slip_mm,s22_mpa,s12_mpa,status",
        ),
        (
            column_names::<TipRow>(&["traffic", "wheel", "wheel"])[17..].join(","),
            "depth_mm,mgt,share_wheel_1,share_wheel_2,turn_deg,jump,load_cycles_error",
        ),
        (column_names::<SifRow>(&["wheel", "wheel"])[9..].join(","), "wheel"),
        (column_names::<ResidualRow>(&[]).join(","), "depth_mm,sxx_mpa,syy_mpa,szz_mpa,sxy_mpa"),
    ];
    for (columns, contract) in wanted {
        assert_eq!(columns, contract);
    }
}

#[test]
fn tables_hold_every_row_with_its_numbers() {
    let scratch = Scratch::new("tables");
    run_through(scratch.path(), SMALL);
    let steps = SMALL.increments + 1;
    let sif = table(scratch.path(), "sif.csv");
    assert_eq!(sif[0], column_names::<SifRow>(&[]).join(","));
    assert_eq!(sif.len(), 1 + steps * 2 * SMALL.positions);
    assert!(sif[1].starts_with("0,1,1,1,1,-40.5,-6.0,"), "{}", sif[1]);
    let growth = table(scratch.path(), "growth.csv");
    assert_eq!(growth[0], column_names::<TipRow>(&["traffic"]).join(","));
    assert_eq!(growth.len(), 1 + steps);
    let fields = |row: usize| growth[row].split(',').collect::<Vec<_>>();
    let (initial, second, last) = (fields(1), fields(2), fields(steps));
    assert_eq!((initial[..3].to_vec(), initial[5], initial[16]), (vec!["0", "1", "1"], "6.0", ""));
    assert_eq!((initial[11], initial[12], second[11], second[12]), ("", "", "65.0", "0.99"));
    assert_eq!((initial[10], fields(4)[10]), ("-2.0", ""));
    assert_eq!((last[13], last[16]), ("0.0", "steps-done"));
    let faces = table(scratch.path(), "faces.csv");
    assert_eq!(faces[0], column_names::<FaceRow>(&[]).join(","));
    assert_eq!(faces.len(), 1 + steps * SMALL.positions * SMALL.face_points);
    assert!(faces[1].starts_with("0,2,1,1,1,0.25,"), "{}", faces[1]);
}

#[test]
fn a_history_reads_back_to_the_same_bits() {
    let scratch = Scratch::new("bits");
    run_through(scratch.path(), SMALL);
    let read: Vec<[u64; 3]> = (table(scratch.path(), "sif.csv").iter().skip(1))
        .map(|row| {
            let fields: Vec<f64> = row.split(',').map(|field| field.parse().unwrap()).collect();
            [fields[5], fields[7], fields[8]].map(f64::to_bits)
        })
        .collect();
    let root = 1000f64.sqrt();
    let mut written = Vec::new();
    for n in 0..=SMALL.increments {
        for passage in step(SMALL, n).0.passages {
            for (xc, sif) in passage.xc.iter().zip(&passage.sifs[0]) {
                written.push([*xc, sif.ki / root, sif.kii / root].map(f64::to_bits));
            }
        }
    }
    assert_eq!(read, written);
}

#[test]
fn a_run_resumes_after_every_step_to_the_same_files() {
    let whole = Scratch::new("whole");
    run_through(whole.path(), SMALL);
    for done in 0..=SMALL.increments + 1 {
        let cut = Scratch::new(&format!("cut-{done}"));
        let mut recorder = Recorder::start(cut.path(), case(), info(), Existing::Refuse, &Pages).unwrap();
        record_steps(&mut recorder, SMALL, 0, done).unwrap();
        drop(recorder);
        assert_eq!(resume_to_the_end(cut.path(), SMALL), done);
        assert_same_run(whole.path(), cut.path(), &format!("killed after {done} steps"));
        // Again after completion: nothing changes.
        assert_eq!(resume_to_the_end(cut.path(), SMALL), SMALL.increments + 1);
        assert_same_run(whole.path(), cut.path(), "resumed after completion");
    }
}

#[test]
fn what_an_unfinished_step_wrote_is_cut_off() {
    let whole = Scratch::new("whole-garbage");
    run_through(whole.path(), SMALL);
    // Killed between tables, within a row, within the summary, within a plot.
    let cut_short =
        ["sif.csv", "growth.csv", "faces.csv", "run-log.bin", "summary.json.partial", "plots/ki.svg.partial"];
    for damaged in cut_short {
        let cut = Scratch::new("garbage");
        let mut recorder = Recorder::start(cut.path(), case(), info(), Existing::Refuse, &Pages).unwrap();
        record_steps(&mut recorder, SMALL, 0, 2).unwrap();
        drop(recorder);
        let path = cut.path().join(damaged);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        let mut bytes = fs::read(&path).unwrap_or_default();
        bytes.extend_from_slice(b"2,1,1,1,1,-40.5,-6.0,0.0,1.5\n2,1,1,1,2,-39.");
        fs::write(&path, bytes).unwrap();
        assert_eq!(resume_to_the_end(cut.path(), SMALL), 2);
        assert_same_run(whole.path(), cut.path(), damaged);
    }
}

#[test]
fn a_step_writes_no_more_after_many_steps() {
    let scratch = Scratch::new("bytes");
    let size = Size { increments: 2000, positions: 3, face_points: 2, cracks: 1 };
    let mut recorder =
        Recorder::start(scratch.path(), case(), info(), Existing::Refuse, &TablesOnly).unwrap();
    let length = |file: &str| fs::metadata(scratch.path().join(file)).unwrap().len();
    // The cracks keep their vertices: with each new one the checkpoint grows.
    let (first, state) = step(size, 0);
    let (mut before, mut written) = (length("run-log.bin"), Vec::new());
    for n in 0..=1000 {
        let record = StepRecord { step: n, fields: None, ..first.clone() };
        recorder.record(&record, &GrowthState { step: n + 1, ..state.clone() }).unwrap();
        let log = length("run-log.bin");
        written.push(log - before + length("checkpoint.bin"));
        before = log;
    }
    // Numbers that count take a byte more from 128 on.
    assert!(written[1000] <= written[10] + 8, "{} and {} bytes", written[10], written[1000]);
    println!("checkpoint and run log: {} bytes in step 10, {} in step 1000", written[10], written[1000]);
}

#[test]
fn without_a_checkpoint_a_run_begins_again() {
    let whole = Scratch::new("whole-early");
    run_through(whole.path(), SMALL);
    let cut = Scratch::new("early");
    let mut recorder = Recorder::start(cut.path(), case(), info(), Existing::Refuse, &Pages).unwrap();
    record_steps(&mut recorder, SMALL, 0, 2).unwrap();
    drop(recorder);
    fs::remove_file(cut.path().join("checkpoint.bin")).unwrap();
    assert_eq!(resume_to_the_end(cut.path(), SMALL), 0);
    assert_same_run(whole.path(), cut.path(), "no checkpoint");
    // Killed while the case itself was being written.
    let newborn = Scratch::new("newborn");
    fs::write(newborn.path().join("case.toml.partial"), &case().toml[..9]).unwrap();
    assert_eq!(resume_to_the_end(newborn.path(), SMALL), 0);
    assert_same_run(whole.path(), newborn.path(), "no case yet");
}

#[test]
fn resuming_needs_a_run_of_the_same_case() {
    let scratch = Scratch::new("refusals");
    let refused = Recorder::resume(scratch.path(), case(), info(), &Pages).unwrap_err();
    assert!(matches!(refused, OutputError::NoRun { .. }), "{refused}");
    run_through(scratch.path(), SMALL);
    let mut other = case();
    other.toml = other.toml.replace("xfem", "dislocation");
    let refused = Recorder::resume(scratch.path(), other, info(), &Pages).unwrap_err();
    assert!(matches!(refused, OutputError::CaseChanged { line: 14, .. }), "{refused}");
    let mut other = case();
    other.companions[0].1 = other.companions[0].1.replace("-100", "-90");
    let refused = Recorder::resume(scratch.path(), other, info(), &Pages).unwrap_err();
    assert!(matches!(refused, OutputError::CaseChanged { line: 2, .. }), "{refused}");
    let checkpoint = scratch.path().join("checkpoint.bin");
    let intact = fs::read(&checkpoint).unwrap();
    for (place, what) in [(0, "magic"), (8, "format"), (40, "content")] {
        let mut bytes = intact.clone();
        bytes[place] ^= 4;
        fs::write(&checkpoint, bytes).unwrap();
        let refused = Recorder::resume(scratch.path(), case(), info(), &Pages).unwrap_err();
        let expected = if what == "format" {
            matches!(refused, OutputError::OtherVersion { .. })
        } else {
            matches!(refused, OutputError::Damaged { .. })
        };
        assert!(expected, "{what}: {refused}");
    }
    fs::write(&checkpoint, intact).unwrap();
    let log = scratch.path().join("run-log.bin");
    let intact = fs::read(&log).unwrap();
    let mut bytes = intact.clone();
    bytes[300] ^= 4;
    for damaged in [&bytes[..], &intact[..intact.len() - 1]] {
        fs::write(&log, damaged).unwrap();
        let refused = Recorder::resume(scratch.path(), case(), info(), &Pages).unwrap_err();
        assert!(refused.to_string().contains("run-log.bin: does not hold what was written"), "{refused}");
    }
    fs::write(&log, intact).unwrap();
    fs::write(scratch.path().join("faces.csv"), "step\n").unwrap();
    let refused = Recorder::resume(scratch.path(), case(), info(), &Pages).unwrap_err();
    assert!(refused.to_string().contains("faces.csv: holds 5 bytes"), "{refused}");
}

#[test]
fn a_run_is_replaced_on_request_only_and_alone() {
    let scratch = Scratch::new("replace");
    run_through(scratch.path(), Size { increments: 2, ..SMALL });
    for own in ["notes.txt", "plots/own.svg"] {
        fs::write(scratch.path().join(own), "mine").unwrap();
    }
    let before = content(scratch.path());
    let refused = Recorder::start(scratch.path(), case(), info(), Existing::Refuse, &Pages).unwrap_err();
    assert!(refused.to_string().contains("--force"), "{refused}");
    assert_eq!(before, content(scratch.path()));
    drop(Recorder::start(scratch.path(), case(), info(), Existing::Replace, &Pages).unwrap());
    let after = content(scratch.path());
    let names: Vec<&str> = after.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "case.toml",
            "faces.csv",
            "growth.csv",
            "inputs/residual-stress.csv",
            "notes.txt",
            "plots/own.svg",
            "run-log.bin",
            "sif.csv",
        ]
    );
    assert_eq!(resume_to_the_end(scratch.path(), SMALL), 0);
}

#[test]
fn what_cannot_be_written_is_said_at_once() {
    let scratch = Scratch::new("unwritable");
    let file = scratch.path().join("file");
    fs::write(&file, "").unwrap();
    for folder in [file.clone(), file.join("below")] {
        let refused = Recorder::start(&folder, case(), info(), Existing::Replace, &Pages).unwrap_err();
        assert!(matches!(refused, OutputError::Io { .. }), "{refused}");
        assert!(refused.to_string().contains(&folder.display().to_string()), "{refused}");
    }
}

#[test]
fn a_step_that_is_not_finite_is_refused_whole() {
    let scratch = Scratch::new("nan");
    // So many rows that the first ones stand in the table before the last ones are made.
    let size = Size { face_points: 120, ..SMALL };
    let spoil: [fn(&mut StepRecord); 4] = [
        |record| record.passages[1].sifs[0][7].kii = f64::NAN,
        |record| record.tips[0].rate = f64::INFINITY,
        |record| record.faces.states[30][2].s22 = f64::NEG_INFINITY,
        |record| record.faces.points[1] = FacePoint { s: f64::NAN, ..record.faces.points[1] },
    ];
    let mut recorder = Recorder::start(scratch.path(), case(), info(), Existing::Refuse, &Pages).unwrap();
    let (good, state) = step(size, 0);
    for spoil in spoil {
        let mut record = good.clone();
        spoil(&mut record);
        let refused = recorder.record(&record, &state).unwrap_err();
        assert!(matches!(refused, OutputError::NotFinite { .. }), "{refused}");
    }
    record_steps(&mut recorder, size, 0, size.increments + 1).unwrap();
    recorder.finish().unwrap();
    let whole = Scratch::new("nan-whole");
    run_through(whole.path(), size);
    assert_same_run(whole.path(), scratch.path(), "after refusals");
}

#[test]
fn the_summary_holds_the_keys_of_the_contract() {
    let scratch = Scratch::new("summary");
    let mut recorder = Recorder::start(scratch.path(), case(), info(), Existing::Refuse, &Pages).unwrap();
    record_steps(&mut recorder, SMALL, 0, 3).unwrap();
    let read = || -> serde_json::Value {
        serde_json::from_slice(&fs::read(scratch.path().join("summary.json")).unwrap()).unwrap()
    };
    let halfway = read();
    assert_eq!((&halfway["complete"], &halfway["stop"]), (&false.into(), &serde_json::Value::Null));
    record_steps(&mut recorder, SMALL, 3, SMALL.increments + 1).unwrap();
    recorder.finish().unwrap();
    let summary = read();
    let keys = "version engine contact wall_s phases_s peak_memory_mb dofs face_points substeps \
                contact_iterations_mean contact_iterations_max complementarity_max passages stop warnings";
    for key in keys.split_whitespace() {
        assert!(summary.get(key).is_some(), "{key}");
    }
    assert!(summary["wall_s"].is_f64());
    assert_eq!(summary["stop"], "steps-done");
    assert_eq!(summary["steps"], SMALL.increments);
    assert_eq!(summary["contact_iterations_mean"], 3.0);
    assert_eq!(summary["phases_s"]["contact"], 1.25 * (SMALL.increments + 1) as f64);
    assert_eq!(summary["phases_s"]["body_condensation"], 0.25 * (SMALL.increments + 1) as f64);
    assert_eq!(summary["warnings"][0]["kind"], "near-tie");
    let cycles = summary["load_cycles"].as_f64().unwrap();
    assert_eq!(summary["million_gross_tonnes"].as_f64().unwrap(), cycles * 17.0 / 1e6);
}

#[test]
fn residual_stress_is_a_table_of_its_own() {
    let scratch = Scratch::new("residual");
    let mut recorder = Recorder::start(scratch.path(), case(), info(), Existing::Refuse, &Pages).unwrap();
    let stress = railcrack::math::Stress { xx: -120.5, yy: 0.0, zz: 1e-7, xy: 0.25 };
    recorder.residual(&[ResidualRow { depth: 0.5, stress }], ResidualSummary::default()).unwrap();
    let rows = table(scratch.path(), "residual.csv");
    assert_eq!(rows, [column_names::<ResidualRow>(&[]).join(",").as_str(), "0.5,-120.5,0.0,1e-7,0.25"]);
}

/// Elements of class `class` in the picture `file`; fails where the picture is no well-formed XML.
fn elements(folder: &Path, file: &str, class: &str) -> usize {
    let text = fs::read_to_string(folder.join("plots").join(file)).unwrap();
    let picture = roxmltree::Document::parse(&text).unwrap();
    assert_eq!(picture.root_element().tag_name().name(), "svg");
    picture.descendants().filter(|node| node.attribute("class") == Some(class)).count()
}

#[test]
fn plots_are_well_formed_and_show_every_series() {
    let one = Scratch::new("plots-one");
    run_through(one.path(), Size { increments: 25, ..SMALL });
    let network = Scratch::new("plots-network");
    run_through(network.path(), Size { increments: 3, cracks: 9, ..SMALL });
    let initial = Scratch::new("plots-initial");
    run_through(initial.path(), Size { increments: 0, ..SMALL });
    // Five steps of one tip; the first and the last step of nine tips; one step.
    for (folder, histories, cracks) in [(&one, 5, 1), (&network, 18, 9), (&initial, 1, 1)] {
        for file in ["ki.svg", "kii.svg"] {
            assert_eq!(elements(folder.path(), file, "series"), histories, "{file}");
        }
        for file in ["paths.svg", "length-cycles.svg"] {
            assert_eq!(elements(folder.path(), file, "series"), cracks, "{file}");
        }
        // Open, stick and slip; the open faces again among the classes of pressure.
        assert!(elements(folder.path(), "faces.svg", "cells") >= 5 * cracks);
    }
    assert!(elements(one.path(), "faces-last.svg", "cells") >= 5);
    assert!(!initial.path().join("plots/faces-last.svg").exists());
}

#[test]
fn plots_are_rebuilt_from_the_folder_alone() {
    let scratch = Scratch::new("rebuild");
    run_through(scratch.path(), SMALL);
    let before = content(scratch.path());
    fs::remove_dir_all(scratch.path().join("plots")).unwrap();
    fs::remove_file(scratch.path().join("checkpoint.bin")).unwrap();
    rebuild_report(scratch.path()).unwrap();
    assert_eq!(before, content(scratch.path()));
    // A half row at the end is not a row.
    let path = scratch.path().join("sif.csv");
    let mut text = fs::read(&path).unwrap();
    text.extend_from_slice(b"4,3,1,1,1,-40.5,-6.0,0.0,1");
    fs::write(&path, &text).unwrap();
    rebuild_report(scratch.path()).unwrap();
    let after = content(scratch.path());
    assert!(
        before.iter().filter(|file| file.0.starts_with("plots")).all(|(name, bytes)| after[name] == *bytes)
    );
    fs::write(&path, "step,passage\n0,1\n").unwrap();
    let refused = rebuild_report(scratch.path()).unwrap_err();
    assert!(refused.to_string().contains("no column crack"), "{refused}");
}

#[test]
fn field_files_are_listed_and_replaced_with_their_run() {
    let scratch = Scratch::new("fields");
    let folder = scratch.path();
    run_through(folder, SMALL);
    let pvd = fs::read_to_string(folder.join("fields.pvd")).unwrap();
    let listed: Vec<&str> = pvd.lines().filter(|line| line.starts_with("<DataSet")).collect();
    assert_eq!(listed.len(), 6, "{pvd}");
    // Of 41 positions, the eleventh of step 2.
    let third =
        "<DataSet timestep=\"2.2439024390243905\" part=\"0\" file=\"fields/step-0002-position-0011.vtu\"/>";
    assert_eq!(listed[2], third);
    let grid = read_vtu(&folder.join("fields/step-0002-position-0011.vtu")).unwrap();
    assert_eq!(grid.cell_array("face").unwrap().values, [0.0, 1.0]);
    assert_eq!(grid.point_array("displacement_mm").unwrap().values[..3], [0.002, 1.0, 0.0]);
    assert_eq!(grid.point_array("traction").unwrap().values[..3], [0.0, 5.0, 0.0]);

    // A new run removes them, and leaves what is not its own.
    for name in ["mine.vtu", "step-0004-position-0021.vtu.partial"] {
        fs::write(folder.join("fields").join(name), "").unwrap();
    }
    Recorder::start(folder, case(), info(), Existing::Replace, &Pages).unwrap();
    let left: Vec<_> = fs::read_dir(folder.join("fields")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left, ["mine.vtu"]);
    assert!(!folder.join("fields.pvd").exists());
}

#[test]
fn a_field_that_is_not_finite_is_refused_with_its_step() {
    let scratch = Scratch::new("endless-field");
    let mut recorder = Recorder::start(scratch.path(), case(), info(), Existing::Refuse, &Pages).unwrap();
    let (mut record, state) = step(SMALL, 0);
    record.fields.as_mut().unwrap().snapshots[1].stress[2].xy = f64::NAN;
    let refused = recorder.record(&record, &state).unwrap_err();
    assert!(refused.to_string().contains("`stress_mpa` is NaN at entry 2"), "{refused}");
    assert_eq!(table(scratch.path(), "growth.csv").len(), 1);
}
