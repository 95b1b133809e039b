//! Closed forms.
use railcrack::body::CrackedBody;
use railcrack::crack::*;
use railcrack::dislocation::*;
use railcrack::material::IsotropicElastic;
use railcrack::math::*;

fn sif(crack: Crack, elements: usize, stress: impl Fn(Vec2) -> Stress) -> Vec<f64> {
    let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
    let body = DislocationBody::new(&crack.into(), &steel, FaceResolution { elements }).unwrap();
    let f = body.faces().nodal_forces(stress);
    body.sif_influence().times(&f)
}

#[test]
fn table() {
    let want = [
        (90.0, 1.12152, 0.0),
        (75., 1.06855, 0.17381),
        (60., 0.92010, 0.30580),
        (45., 0.70491, 0.36449),
        (30., 0.46243, 0.33614),
        (15., 0.23173, 0.22609),
        (165., 0.23173, -0.22609),
    ];
    for n in [10, 20, 40, 80, 160] {
        for (angle, k1, k2) in want {
            let t = std::time::Instant::now();
            let c = Crack::surface_breaking(0.0, 6.0, f64::to_radians(angle)).unwrap();
            let k = sif(c, n, |_| Stress { xx: 1.0, ..Stress::ZERO });
            let s = (std::f64::consts::PI * 6.0).sqrt();
            println!(
                "{n} {angle}: {:.6} {:.6}  err {:.2e} {:.2e}  {:?}",
                k[0] / s,
                k[1] / s,
                k[0] / s - k1,
                k[1] / s - k2,
                t.elapsed()
            );
        }
    }
    for n in [20, 40, 80] {
        let c = Crack::polyline(vec![Vec2::new(0., -1000.), Vec2::new(4., -1000.)]).unwrap();
        let k = sif(c, n, |_| Stress { yy: 1.0, xy: 1.0, ..Stress::ZERO });
        let s = (std::f64::consts::PI * 2.0).sqrt();
        println!("buried {n}: {:?}", k.iter().map(|k| k / s).collect::<Vec<_>>());
    }
    for n in [20, 40, 80, 160] {
        for beta in [30.0f64, 60., -60.] {
            let c = Crack::surface_breaking(0.0, 4.0, f64::to_radians(15.))
                .unwrap()
                .extended(End::Last, 2.0, beta.to_radians())
                .unwrap();
            let k = sif(c, n, |_| Stress { xx: 1.0, ..Stress::ZERO });
            let s = (std::f64::consts::PI * 6.0).sqrt();
            println!("kink {beta} {n}: {:?}", k.iter().map(|k| k / s).collect::<Vec<_>>());
        }
    }
}
