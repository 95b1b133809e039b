//! Stress intensity factors do not depend on the domain of integration.

use crate::common::{Meshed, Of, Rolling, TENSION, close, largest, sifs_under, surface_crack};
use railcrack::body::CrackedBody;
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, End};
use railcrack::xfem::XfemSettings;

/// Spread of K over its peak.
const SPREAD: f64 = 5e-3;
/// Outer over default radii: a factor of three between the first and the last.
const SCALES: [f64; 4] = [0.8, 1.0, 1.6, 2.4];

fn with_domains<T>(meshed: &Meshed, cracks: &[Crack], look: impl Fn(&CrackedBody) -> T) -> Vec<T> {
    meshed.with_bodies(cracks, |_, body| {
        let defaults = XfemSettings::default();
        let scaled = |scale| XfemSettings {
            domain_inner: scale * defaults.domain_inner,
            domain_outer: scale * defaults.domain_outer,
            ..defaults
        };
        SCALES.map(|scale| look(&body(scaled(scale)))).into_iter().collect()
    })
}

/// The largest difference of rows from that of the default domain, relative to the largest value of
/// all.
fn spread(rows: &[Vec<f64>]) -> f64 {
    let peak = largest(rows.iter().flatten().copied());
    largest(rows.iter().flat_map(|row| row.iter().zip(&rows[1]).map(|(a, b)| a - b))) / peak
}

fn kinked(length: f64, kink: f64, beta: f64) -> Crack {
    surface_crack(0.0, length, 15.0).extended(End::Last, kink, beta.to_radians()).unwrap()
}

fn cracks() -> Vec<(&'static str, Crack, Meshed)> {
    let three_elements = Meshed { element_size: Some(0.1), ..Meshed::still() };
    vec![
        ("straight, 15°", surface_crack(0.0, 6.0, 15.0), Meshed::still()),
        ("straight, 90°", surface_crack(0.0, 6.0, 90.0), Meshed::still()),
        ("kink of −30°", kinked(4.0, 2.0, -30.0), Meshed::still()),
        ("kink of −60°", kinked(4.0, 2.0, -60.0), Meshed::still()),
        ("kink of −30°, three elements", kinked(5.7, 0.3, -30.0), three_elements.clone()),
        ("kink of −60°, three elements", kinked(5.7, 0.3, -60.0), three_elements.clone()),
        ("kink of +30°, three elements", kinked(5.7, 0.3, 30.0), three_elements),
    ]
}

#[test]
fn open() {
    for (name, crack, meshed) in cracks() {
        let k = with_domains(&meshed, &[crack], |body| sifs_under(body, |_| TENSION));
        println!("{name}: {:.3} % {k:.4?}", 100.0 * spread(&k));
        close(spread(&k), 0.0, Of(SPREAD, 1.0), name);
    }
}

/// Under the wheel, with friction: C does not depend on the domain, so the faces behave identically
/// and only K differs.
#[test]
fn closed_with_friction() {
    for (name, crack, meshed) in cracks() {
        let rolling = Rolling::over(vec![crack.clone()], 0.5, 0.1);
        let histories = with_domains(&meshed, &[crack], |body| {
            let result = rolling.on(&FaceProblem::new(body, &[0.5]).unwrap(), &Newton::default());
            let passage = &result.passages[result.passages.len() - 1];
            passage.sifs[0].iter().flat_map(|k| [k.ki, k.kii]).collect::<Vec<f64>>()
        });
        println!("{name}: {:.3} %", 100.0 * spread(&histories));
        close(spread(&histories), 0.0, Of(SPREAD, 1.0), name);
    }
}
