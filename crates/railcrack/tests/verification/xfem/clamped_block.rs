//! The paper's block with its bottom clamped, against a conforming mesh of quadratic elements.

use crate::common::{Meshed, Rolling, RollingEngine, measured, misfit, surface_crack, table_histories};
use railcrack::bulk::{BottomSupport, SideSupport};
use railcrack::math::RailBox;
use railcrack::xfem::RailEnd;

/// Largest difference of K at any position, relative to its peak. The locked K_II of the reference
/// is itself 0.5 % low.
const PROMISED: f64 = 0.015;

#[test]
fn table1() {
    let mut rolling = Rolling::over(vec![surface_crack(0.0, 6.0, 15.0)], 0.5, 0.025);
    let end = RailEnd::Block {
        extent: RailBox { width: 300.0, depth: 172.0, centre: 0.0 },
        bottom: BottomSupport::Clamped,
        sides: SideSupport::Free,
    };
    rolling.engine = RollingEngine::Xfem(Meshed { end, ..Meshed::default() });
    let (error, place) = misfit(&rolling.solve(), &table_histories("clamped-block/table1.csv"));
    println!("{:.3} % of the peak, {place}", 100.0 * error);
    measured(error, PROMISED, "1.5 % of the peak: the reference is itself 0.5 % low");
    assert!(error < PROMISED, "{:.3} % of the peak, {place}", 100.0 * error);
}
