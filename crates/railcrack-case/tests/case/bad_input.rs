//! Every way of getting a case file wrong that we know, and what is said about it.

use railcrack_case::{Case, CaseErrors};
use std::fs;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, DeValue};

/// A good case of nine lines; what is appended to it begins on line 10.
const GOOD: &str = include_str!("bad_input/good/plane.toml");

/// A good case in space.
const SPACE: &str = include_str!("bad_input/good/space.toml");

fn errors(text: &str) -> CaseErrors {
    match Case::parse(text, "case.toml", Path::new("no-such-folder")) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(errors) => errors,
    }
}

/// A `[[wrong]]` of the tables in `bad_input`: a good case, spoilt, and the one error of it.
///
/// `whole` is the text; or `good` ("space"; plane without it), in which `replace` is written as
/// `by`, followed by `append`. The error stands on `line`, names `key` (none in what is no TOML),
/// and has `says` in its message and `helps` in its help.
struct Wrong<'a>(&'a DeTable<'a>);

impl Wrong<'_> {
    const KEYS: [&'static str; 9] =
        ["whole", "good", "replace", "by", "append", "line", "key", "says", "helps"];

    fn has(&self, key: &str) -> Option<&str> {
        self.0.get(key).map(|value| value.get_ref().as_str().unwrap_or_else(|| panic!("{key}: not a text")))
    }

    fn line(&self) -> Option<usize> {
        match self.0.get("line")?.get_ref() {
            DeValue::Integer(line) => line.as_str().parse().ok(),
            _ => None,
        }
    }

    fn text(&self) -> String {
        if let Some(whole) = self.has("whole") {
            return whole.into();
        }
        let good = match self.has("good") {
            None => GOOD,
            Some("space") => SPACE,
            Some(other) => panic!("no good case {other}"),
        };
        let replaced = match (self.has("replace"), self.has("by")) {
            (Some(old), Some(new)) => {
                assert!(good.contains(old), "{old}");
                good.replacen(old, new, 1)
            }
            (None, None) => good.into(),
            _ => panic!("`replace` goes with `by`: {:?}", self.0),
        };
        replaced + self.has("append").unwrap_or_default()
    }

    fn check(&self) {
        if let Some(key) = self.0.keys().find(|key| !Self::KEYS.contains(&key.get_ref().as_ref())) {
            panic!("{}: none of {:?}", key.get_ref(), Self::KEYS);
        }
        let text = self.text();
        let errors = errors(&text);
        let all = errors.to_string();
        let first = &errors.errors()[0];
        assert_eq!(errors.errors().len(), 1, "one thing is wrong, one error:\n{text}\n{all}");
        assert_eq!(first.file(), "case.toml");
        let line = first.position().map_or(0, |(line, _)| line);
        assert_eq!(Some(line), self.line(), "line of\n{text}\n{all}");
        assert_eq!(first.key(), self.has("key"), "key of\n{text}\n{all}");
        let says = self.has("says").expect("a piece of the message");
        assert!(first.message().contains(says), "`{says}` in the message of\n{text}\n{all}");
        let helps = self.has("helps").unwrap_or_default();
        assert!(first.help().unwrap_or_default().contains(helps), "`{helps}` in the help of\n{text}\n{all}");
    }
}

#[test]
fn every_wrong_case_is_refused_at_its_place() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/case/bad_input");
    let tables: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_file())
        .collect();
    assert!(tables.len() > 10, "{tables:?}");
    for path in tables {
        println!("{}", path.display());
        let text = fs::read_to_string(&path).unwrap();
        let table = DeTable::parse(&text).unwrap().into_inner();
        for wrong in table["wrong"].get_ref().as_array().unwrap().iter() {
            Wrong(wrong.get_ref().as_table().unwrap()).check();
        }
    }
}

#[test]
fn names_of_the_top() {
    let top = errors(&format!("steps = 5\n{GOOD}"));
    assert_eq!(top.errors()[0].help(), Some("`steps` is a key of [growth]"));
    let top = errors(&format!("tilte = \"x\"\n{GOOD}"));
    assert!(top.to_string().contains("nearest known key: `title`, of the top of the file"), "{top}");
}

#[test]
fn nothing_at_all() {
    let empty = errors("");
    let keys: Vec<_> = empty.errors().iter().filter_map(|e| e.key()).collect();
    assert_eq!(keys, ["contact", "crack"]);
    assert_eq!(empty.errors()[0].position(), Some((1, 1)));
}

#[test]
fn too_long_a_list() {
    let many = format!("{GOOD}[output]\nfields_over_a = [{}]", "0, ".repeat(101));
    assert!(errors(&many).to_string().contains("101 given"));
}

#[test]
fn only_inf_is_infinity() {
    let text = |radius: &str| {
        let load = format!("line_load_n_per_mm = 9000\nwheel_radius_mm = 460\nrail_radius_mm = {radius}");
        GOOD.replace("peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75", &load)
    };
    assert!(Case::parse(&text("inf"), "case.toml", Path::new("")).is_ok());
    for radius in ["1e400", "nan", "-inf", "0", "-300"] {
        let errors = errors(&text(radius));
        assert_eq!(errors.errors()[0].key(), Some("contact.rail_radius_mm"), "{errors}");
        assert!(errors.to_string().contains("must be a number in [0.01, inf] mm"), "{errors}");
    }
}

#[test]
fn all_errors_at_once() {
    let text = "[rail]\nwidth_mm = -1\nfoo = 1\n[contact]\npeak_pressure_mpa = nan\n[[crack]]\nlength_mm = 0\n\
                [growth]\nsteps = 1.0\n[solver]\nengine = \"fem\"\n";
    let keys: Vec<String> =
        errors(text).errors().iter().filter_map(|e| e.key().map(str::to_string)).collect();
    let want = [
        "rail.width_mm",
        "rail.foo",
        "contact.half_width_mm",
        "contact.friction",
        "contact.peak_pressure_mpa",
        "crack[1].mouth_mm",
        "crack[1].angle_deg",
        "crack[1].friction",
        "crack[1].length_mm",
        "growth.steps",
        "solver.engine",
    ];
    assert_eq!(keys, want);
}

#[test]
fn one_line_names_file_line_and_column() {
    let errors = errors(&format!("{GOOD}[growth]\nsteps = -1\n"));
    assert_eq!(errors.to_string(), "case.toml:11:9: `growth.steps = -1`: must be an integer from 0 to 10000");
}

#[test]
fn the_good_case_is_good() {
    let case = Case::parse(GOOD, "case.toml", Path::new("")).unwrap();
    assert_eq!(case.cracks.cracks().len(), 1);
}

/// A mix of wheels, of which one thing is wrong.
#[test]
fn wheels_that_make_no_mix() {
    let crack = "[[crack]]\nmouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0.5\n";
    let contact = "contact = { peak_pressure_mpa = 845, half_width_mm = 6.75, friction = 0.1 }";
    let mix = |second: &str| {
        format!("{crack}[[wheel]]\nshare = 0.5\naxle_load_t = 20\n{contact}\n[[wheel]]\n{second}\n")
    };
    for (second, key, says) in [
        (format!("share = 0.4\naxle_load_t = 20\n{contact}"), "wheel[2].share", "add up to 0.9"),
        (format!("share = 0.5\n{contact}"), "wheel[2].axle_load_t", "is missing"),
        ("share = 0.5\naxle_load_t = 20".to_owned(), "wheel[2].contact", "is missing"),
        (format!("axle_load_t = 20\n{contact}"), "wheel[2]", "needs `share`, or `table` and"),
        (
            "share = 0.5\naxle_load_t = 20\n[wheel.contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6\nfriction = 2.0"
                .to_owned(),
            "wheel[2].contact.friction",
            "must be",
        ),
        (format!("share = 0.5\naxle_load_t = 20\nspeed = 3\n{contact}"), "wheel[2].speed", "unknown key"),
    ] {
        let errors = Case::parse(&mix(&second), "case.toml", Path::new("")).unwrap_err();
        let text = errors.to_string();
        assert!(text.contains(key) && text.contains(says), "{second}\n{text}");
    }
}
