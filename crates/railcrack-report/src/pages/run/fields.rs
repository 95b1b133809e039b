//! The deformed surroundings of the cracks, and the field files.

use crate::chart::{Chart, ChartAspect, ChartAxis, ChartRange};
use crate::numbers::fixed;
use crate::page::{Block, Section};
use crate::page_data::{CrackFaces, PageData};
use crate::table::{Cell, MISSING, Table};
use railcrack::contact::FaceStatus;
use railcrack_run::field_file;
use railcrack_run::files::FIELDS_FILE;

const FIELDS: &str = include_str!("../../assets/fields.html");
const FIELDS_SCRIPT: &str = include_str!("../../assets/fields.js");
/// Maximum number of rows of the table of files; the collection lists all.
const ROWS: usize = 24;

/// The section; none where the run has no fields.
pub(super) fn section(page_data: &PageData) -> Option<Section> {
    let fields = &page_data.fields;
    if fields.is_empty() {
        return None;
    }
    let picture = match fields.data() {
        None => Block::Text(format!(
            "The fields in fields/ have too many cells to be shown here; open {FIELDS_FILE} in ParaView."
        )),
        Some(data) => Block::Viewer {
            id: "neighbourhood",
            html: FIELDS,
            blocks: fields.extent().map(|extent| Block::charts([frame(extent)])).into_iter().collect(),
            data_id: "field-data",
            data,
            script: FIELDS_SCRIPT,
        },
    };
    let (id, heading) = ("around".to_owned(), "Deformation around the cracks".to_owned());
    Some(Section::new(id, heading, vec![picture, Block::Table(files(page_data))]))
}

/// Room for the cells of all fields.
fn frame([[left, right], [bottom, top]]: [[f64; 2]; 2]) -> Chart {
    let air = 0.04 * (right - left);
    Chart {
        id: "field".to_owned(),
        caption: "Deformed neighbourhood of the cracks.".to_owned(),
        x: ChartAxis::linear("x", "mm").over(ChartRange::Exact([left - air, right + air])),
        y: ChartAxis::depth().over(ChartRange::Exact([-top - air, -bottom + air])),
        aspect: ChartAspect::Equal,
        ..Chart::default()
    }
}

/// The files, and where the cracks are open in them.
fn files(page_data: &PageData) -> Table {
    let mut table = Table::new(["File", "Step", "x_{c}/a", "Crack faces", "Largest K_{I} (MPa√m)"]);
    table.caption = "Field files for ParaView and PyVista, with the open length of the crack faces. \
                     Warping by displacement_mm shows an opening only there; closed faces slide \
                     along each other"
        .to_owned();
    table.row([Cell::linked(FIELDS_FILE, FIELDS_FILE), "all files".into()]);
    for (step, position) in page_data.fields.files().take(ROWS) {
        let file = field_file(step, position);
        let histories = page_data.histories(step);
        let at = position - 1;
        let place = histories.first().and_then(|history| history.xc_over_a.get(at));
        let ki = histories.iter().filter_map(|history| history.ki.get(at)).copied().reduce(f64::max);
        let faces =
            page_data.end_faces().find(|(end, _)| *end == step).map(|(_, faces)| open(&faces.cracks, at));
        table.row([
            Cell::linked(file.rsplit('/').next().unwrap_or(&file), &file),
            step.to_string().into(),
            place.map_or_else(|| MISSING.to_owned(), |place| fixed(*place, 2)).into(),
            faces.unwrap_or_else(|| MISSING.to_owned()).into(),
            ki.map_or_else(|| MISSING.to_owned(), |ki| fixed(ki, 2)).into(),
        ]);
    }
    table
}

/// How much of the faces is open at a position (from 0).
fn open(cracks: &[CrackFaces], position: usize) -> String {
    let [mut open, mut whole] = [0.0, 0.0];
    for faces in cracks.iter().filter(|faces| position < faces.positions()) {
        for place in 1..faces.s.len() {
            let length = faces.s[place] - faces.s[place - 1];
            let ends = [place - 1, place].map(|point| faces.state(position, point).0 == FaceStatus::Open);
            // An element with one open end is open over half of it.
            open += 0.5 * length * ends.map(|is_open| f64::from(u8::from(is_open))).iter().sum::<f64>();
            whole += length;
        }
    }
    if open == 0.0 {
        "closed".to_owned()
    } else {
        format!("open over {} of {} mm", fixed(open, 2), fixed(whole, 2))
    }
}
