//! The same bits with one and with two threads.

use crate::common::{Rolling, body, surface_crack};
use railcrack::contact::{FaceProblem, Newton};
use railcrack::fracture::SifHistory;
use railcrack::math::Matrix;

fn with_threads(number: usize) -> (Matrix, Matrix, Vec<SifHistory>) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(number).build().unwrap();
    pool.install(|| {
        let cracks = vec![surface_crack(0.0, 6.0, 15.0), surface_crack(-1.0, 6.0, 165.0)];
        let rolling = Rolling::over(cracks, 0.5, 0.025);
        let body = body(&rolling.cracks, rolling.elements);
        let problem = FaceProblem::new(&body, &[0.5, 0.5]).unwrap();
        let histories = rolling.on(&problem, &Newton::default()).histories;
        (body.compliance.clone(), body.sif_influence.clone(), histories)
    })
}

#[test]
fn same_bits() {
    assert!(with_threads(1) == with_threads(2), "a result depends on the number of threads");
}
