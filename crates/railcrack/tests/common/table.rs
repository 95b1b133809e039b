//! Reference tables under `verification/`.

use railcrack::fracture::Sif;
use std::path::PathBuf;

/// The rows of a CSV file below `verification/`: text by column name. Lines that begin with `#` are
/// comments.
pub fn rows(file: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../verification").join(file);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let rows = lines.map(|line| line.split(',').map(|v| v.trim().parse().unwrap()).collect()).collect();
    (header, rows)
}

/// The column `name` of [`rows`].
pub fn column(table: &(Vec<String>, Vec<Vec<f64>>), name: &str) -> Vec<f64> {
    let index = table.0.iter().position(|n| n == name).unwrap_or_else(|| panic!("no column {name}"));
    table.1.iter().map(|row| row[index]).collect()
}

/// The history of one crack's tip: x_c/a, and K in MPa √mm.
#[derive(Debug, Clone)]
pub struct History {
    pub xc_over_a: Vec<f64>,
    pub sifs: Vec<Sif>,
}

/// The histories of all cracks in a file of `half-plane-histories`, in order.
pub fn histories(name: &str) -> Vec<History> {
    table_histories(&format!("half-plane-histories/{name}.csv"))
}

/// The histories of all cracks in a file below `verification/`, in order.
pub fn table_histories(file: &str) -> Vec<History> {
    let table = rows(file);
    let (xc, k1, k2) =
        (column(&table, "xc_over_a"), column(&table, "ki_mpa_sqrt_m"), column(&table, "kii_mpa_sqrt_m"));
    let cracks =
        if table.0.iter().any(|n| n == "crack") { column(&table, "crack") } else { vec![1.0; xc.len()] };
    let mut histories: Vec<History> = Vec::new();
    let root = 1000f64.sqrt();
    for (row, &crack) in cracks.iter().enumerate() {
        if histories.len() < crack as usize {
            histories.push(History { xc_over_a: Vec::new(), sifs: Vec::new() });
        }
        let history = &mut histories[crack as usize - 1];
        history.xc_over_a.push(xc[row]);
        history.sifs.push(Sif { ki: k1[row] * root, kii: k2[row] * root });
    }
    histories
}
