//! Which sections of a case work together: every pair is tried, and the page of the book is what
//! comes out.

use super::common::{done, folder, read};
use railcrack_case::Case;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// A feature of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Mix,
    Network,
    Groups,
    Fluid,
    Maintenance,
    Scatter,
    Plastic,
    Fracture,
    Track,
    Temperature,
    Table,
    Rolling,
    Coupled,
    Latin,
    Block,
    Section,
    Space,
    Free,
    Plan,
}

use Part::*;

const PARTS: [(Part, &str, &str); 19] = [
    (Mix, "mix", "several wheels, `[[wheel]]`, in both directions"),
    (Network, "network", "several cracks"),
    (Groups, "groups", "`[solver] network = \"groups\"`"),
    (Fluid, "fluid", "trapped, `[fluid]`, `[wheel.fluid]`; groups accept pressure from the mouth"),
    (Maintenance, "maintenance", "`[maintenance]`, wear and grinding"),
    (Scatter, "scatter", "`[inspection]` with `[scatter]`"),
    (Plastic, "plastic", "`[plastic_stress]` computed from `[shakedown]`"),
    (Fracture, "fracture", "`[fracture]`"),
    (Track, "track", "`[track]`, `[wheel.track]`"),
    (Temperature, "cold", "`[temperature]`, `[wheel.temperature]`"),
    (Table, "table", "`[[wheel]] table`, the wheels of a table, beside one wheel of a mix"),
    (Rolling, "rolling", "`[contact] kind = \"rolling\"`, from creepages"),
    (Coupled, "coupled", "`[contact] coupled = true`, a wheel that feels the cracks"),
    (Latin, "LATIN", "`[solver] contact = \"latin\"`"),
    (Block, "block", "`[rail] boundary = \"block\"`"),
    (Section, "section", "`[rail] section`, a cracked rail with head, web and foot"),
    (Space, "space", "`[solver] engine = \"space\"`"),
    (Free, "free front", "`[growth] front = \"free\"`, in space"),
    (Plan, "plan", "`railcrack plan`, grinding depths and intervals"),
];

/// Keys of a rolling wheel but for its load.
const ROLLING: &str =
    "semi_axes_mm = [6.0,5.0], creepage_x = 0.001, creepage_sign = \"contact\", friction = 0.3";

/// The wheels of a table.
const WHEELS: &str = "\
wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm,share
1,90,0,0.001,0,0,0.3,6.0,5.0,0.7
2,70,0,-0.001,0,0,0.3,5.5,5.0,0.3
";

/// A folder `name` with the table of wheels.
fn place(name: &str) -> PathBuf {
    let place = folder("combinations", name);
    std::fs::write(place.join("wheels.csv"), WHEELS).unwrap();
    place
}

/// A quick case with `parts`.
fn text(parts: &[Part]) -> String {
    let has = |part| parts.contains(&part) || part == Space && parts.contains(&Free);
    let mut text = String::from("[passage]\npositions = 13\nmax_passages = 2\n");
    text += "[growth]\nsteps = 1\nparis_c = 2e-9\nincrement = 0.05\narrest_rate_mm_per_cycle = 1e-14\n";
    text += if has(Free) { "front = \"free\"\nfront_harmonics = 4\n" } else { "" };
    // Grinding shortens the cracks, and needs smaller elements.
    text += if has(Space) && has(Plan) {
        "[mesh]\nspace_cells = 4\nspace_rings = 2\n"
    } else if has(Space) {
        "[mesh]\nspace_cells = 2\nspace_rings = 2\n"
    } else if has(Block) && has(Plan) {
        "[mesh]\nelement_size_mm = 0.3\n"
    } else if has(Block) {
        "[mesh]\nelement_size_mm = 0.5\n"
    } else {
        "[mesh]\ninterface_elements = 8\n"
    };
    let engine = if has(Space) {
        "space"
    } else if has(Block) {
        "xfem"
    } else {
        "dislocation"
    };
    let _ = writeln!(text, "[solver]\nengine = \"{engine}\"");
    text += if has(Groups) { "network = \"groups\"\n" } else { "" };
    text += if has(Latin) { "contact = \"latin\"\n" } else { "" };
    text += if has(Block) || has(Section) { "[rail]\n" } else { "" };
    text += if has(Block) { "boundary = \"block\"\n" } else { "" };
    text += if has(Section) { "section = \"60E1\"\n" } else { "" };
    let across = if has(Space) { ", lateral_half_width_mm = 5.0" } else { "" };
    let coupled = if has(Coupled) { ", coupled = true, surface_nodes_per_half_width = 10" } else { "" };
    let contact = |peak: f64| {
        if has(Rolling) {
            let coupled = if has(Coupled) { ", coupled = true" } else { "" };
            format!("kind = \"rolling\", normal_kn = {:?}, {ROLLING}{coupled}", 0.1 * peak)
        } else {
            format!("peak_pressure_mpa = {peak:?}, half_width_mm = 6.0, friction = 0.2{across}{coupled}")
        }
    };
    let fluid = "model = \"trapped\"";
    let track = "section = \"60E1\", wheel_load_kn = 100.0";
    let cold = "rail_c = 5.0, neutral_c = 25.0";
    if has(Mix) || has(Table) {
        for (share, peak, direction) in [(0.6, 900.0, "+x"), (0.4, 750.0, "-x")] {
            let _ = if has(Table) && share == 0.6 {
                writeln!(
                    text,
                    "[[wheel]]\ntable = \"wheels.csv\"\ncreepage_sign = \"vehicle\"\naxle_load_t = 20.0"
                )
            } else {
                writeln!(
                    text,
                    "[[wheel]]\nshare = {share}\naxle_load_t = 20.0\ndirection = \"{direction}\"\ncontact = {{ {} }}",
                    contact(peak)
                )
            };
            // The first wheel has the section of its own, the second one that of the case.
            let own = share == 0.6;
            for (part, name, keys) in
                [(Fluid, "fluid", fluid), (Track, "track", track), (Temperature, "temperature", cold)]
            {
                if own && has(part) {
                    let _ = writeln!(text, "{name} = {{ {keys} }}");
                }
            }
        }
    } else {
        let _ = writeln!(text, "[contact]\n{}", contact(900.0).replace(", ", "\n"));
        text += "[traffic]\naxle_load_t = 20.0\n";
    }
    for (part, name, keys) in
        [(Fluid, "fluid", fluid), (Track, "track", track), (Temperature, "temperature", cold)]
    {
        if has(part) {
            let _ = writeln!(text, "[{name}]\n{}", keys.replace(", ", "\n"));
        }
    }
    let along = if has(Space) { "surface_half_length_mm = 4.0\n" } else { "" };
    let _ = writeln!(
        text,
        "[[crack]]\nmouth_mm = 0.0\nlength_mm = 3.0\nangle_deg = 30.0\nfriction = 0.3\n{along}"
    );
    if has(Network) {
        let _ = writeln!(
            text,
            "[[crack]]\nmouth_mm = 12.0\nlength_mm = 3.5\nangle_deg = 25.0\nfriction = 0.3\n{along}"
        );
    }
    text += if has(Maintenance) {
        "[maintenance]\nwear_mm_per_mgt = 0.001\ngrinding_mm = 0.05\ngrinding_interval_mgt = 20.0\n"
    } else {
        ""
    };
    text += if has(Scatter) || has(Plan) {
        "[inspection]\ndetectable_depth_mm = 1.6\ncritical_depth_mm = 3.0\n"
    } else {
        ""
    };
    text += if has(Scatter) { "[scatter]\nsamples = 50\n" } else { "" };
    text +=
        if has(Plastic) { "[plastic_stress]\n[shakedown]\nsteel = \"R260\"\nmax_passes = 5\n" } else { "" };
    text += if has(Fracture) { "[fracture]\ntoughness_mpa_sqrt_m = 60.0\n" } else { "" };
    text
}

/// Why a case with `parts` is refused; none where it is accepted.
fn refusal(parts: &[Part], place: &Path) -> Option<String> {
    let errors = Case::parse(&text(parts), "case.toml", place).err()?;
    let all: Vec<String> = errors.errors().iter().map(|error| error.message().to_owned()).collect();
    assert_eq!(all.len(), 1, "{parts:?}: one thing is wrong:\n{}\n{errors}", text(parts));
    Some(all[0].clone())
}

/// Everything that works with everything else of it.
const TOGETHER: [Part; 10] =
    [Mix, Network, Fluid, Maintenance, Scatter, Plastic, Fracture, Track, Temperature, Section];

/// The page of the book.
fn page(place: &Path) -> String {
    let mut page = String::from(
        "# Which sections work together\n\n\
         Every pair of these features works together, but for those that are listed below: a test\n\
         tries each pair and writes this page. A case with a refused pair ends with the sentence\n\
         shown, before anything is computed.\n\n| feature | is |\n|---|---|\n",
    );
    for (_, name, meaning) in PARTS {
        let _ = writeln!(page, "| {name} | {meaning} |");
    }
    let mut refusals: Vec<(String, Vec<String>)> = Vec::new();
    for (row, (one, name, _)) in PARTS.iter().enumerate() {
        for (other, with, _) in &PARTS[row + 1..] {
            let Some(says) = refusal(&[*one, *other], place) else { continue };
            let pair = format!("{name} with {with}");
            match refusals.iter_mut().find(|(known, _)| *known == says) {
                Some((_, pairs)) => pairs.push(pair),
                None => refusals.push((says, vec![pair])),
            }
        }
    }
    page.push_str("\nRefused:\n\n");
    for (says, pairs) in &refusals {
        let item = wrapped(&format!("* **{}**: {says}", pairs.join(", ")));
        page.push_str(&item.trim_end().replace('\n', "\n  "));
        page.push('\n');
    }
    assert_eq!(refusal(&TOGETHER, place), None);
    let together: Vec<&str> =
        PARTS.iter().filter(|(part, _, _)| TOGETHER.contains(part)).map(|(_, name, _)| *name).collect();
    let (last, others) = together.split_last().unwrap();
    let sentence = format!("All of {} and {last} work in one case.", others.join(", "));
    page.push('\n');
    page.push_str(&wrapped(&sentence));
    page
}

/// `text` in lines of at most 97 columns, 100 with an indentation.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last_mut().unwrap();
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > 97 {
            lines.push(word.to_owned());
        } else {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines.join("\n") + "\n"
}

/// The page is what a case says of every pair.
#[test]
fn the_page_of_combinations_is_what_the_program_accepts() {
    let place = place("page");
    for (part, name, _) in PARTS {
        assert_eq!(refusal(&[part], &place), None, "{name} alone");
    }
    let page = page(&place);
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/combinations.md"));
    let stored = std::fs::read_to_string(&path).unwrap_or_default();
    if stored != page {
        let new = place.join("combinations.md");
        std::fs::write(&new, &page).unwrap();
        panic!("docs/combinations.md differs from what the program accepts; the new page: {}", new.display());
    }
}

/// Accepted combinations are computed.
#[test]
fn all_of_it_together_is_computed() {
    let place = place("together");
    std::fs::write(place.join("case.toml"), text(&TOGETHER)).unwrap();
    done(&place, &["run", "case.toml", "--quiet", "--out", "run"]);
    assert!(read(&place.join("run/summary.json")).contains("\"rolled\""));
}

#[test]
#[ignore = "extra: a hundred runs of a second"]
fn every_accepted_pair_is_computed_in_full() {
    let place = place("pairs");
    let plan = ["plan", "case.toml", "--grinding", "0.05", "--interval", "0.5", "--horizon", "1"];
    for (i, (one, name, _)) in PARTS.iter().enumerate() {
        for (other, beside, _) in &PARTS[i..] {
            if refusal(&[*one, *other], &place).is_none() {
                println!("{name} with {beside}");
                std::fs::write(place.join("case.toml"), text(&[*one, *other])).unwrap();
                let command = if *other == Plan { &plan[..] } else { &["run", "case.toml"] };
                done(&place, &[command, &["--quiet", "--force", "--out", "out"]].concat());
            }
        }
    }
}
