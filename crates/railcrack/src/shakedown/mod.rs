//! Plasticity under repeated passages.

mod anderson;
mod bounds;
mod eigenstress;
mod fourier;
mod layers;
mod steady;
mod strain;
mod streamline;
mod wave;

pub use bounds::{FirstYield, ShakedownLimit, first_yield_ratio, shakedown_limit_ratio};
pub use layers::Layers;
pub use strain::PlasticStrain;

#[cfg(test)]
mod experiment {
    use super::*;
    use super::eigenstress::*;
    use super::steady::*;
    use super::streamline::*;
    use crate::field::HertzField;
    use crate::load::HertzianContact;
    use crate::material::*;
    use crate::math::Vec2;

    #[test]
    #[ignore]
    fn reference() {
        let env = |k: &str, d: f64| std::env::var(k).ok().and_then(|v| v.parse().ok()).unwrap_or(d);
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let hard = KinematicHardening::new(500.0, env("C", 20e3)).unwrap();
        let a = 6.75;
        let contact = HertzianContact { peak_pressure: env("P", 1100.0), half_width: a, friction: env("MU", 0.1) };
        let n = env("NX", 32.0);
        let ny = env("NY", 32.0);
        let columns = env("N", 1024.0) as usize;
        let layers = Layers::graded(a / ny, env("FINE", 1.8) * a, env("DEEP", 2.2) * a);
        let spacing = a / n;
        let field = HertzField::new(&contact, 0.3);
        let depths = layers.middles();
        let r = depths.len();
        let mut background: Columns = [vec![0.0; columns * r], vec![0.0; columns * r], vec![0.0; columns * r]];
        for i in 0..columns {
            let x = (i as f64 - 0.5 * columns as f64) * spacing;
            for j in 0..r {
                let d = field.stress(Vec2::new(x, -depths[j]), 0.0).deviator();
                for c in 0..3 { background[c][i * r + j] = d[c]; }
            }
        }
        let law = FlowLaw::new(&steel, &hard);
        let scale = 2.0 * steel.shear_modulus() / hard.yield_radius();
        let mut problem = SteadyProblem {
            eigenstress: Eigenstress::new(&steel, columns, spacing, layers),
            law, background, strain_scale: scale, tolerance: env("TOL", 1e-6), max_iterations: 400,
        };
        let t0 = std::time::Instant::now();
        let mut up = vec![[0.0; 3]; r];
        let mut start: Columns = [vec![0.0; columns * r], vec![0.0; columns * r], vec![0.0; columns * r]];
        let profile = |up: &Vec<[f64;3]>, j: usize| { let e = PlasticStrain::from_deviator(up[j]); let ep=210e3/0.91;
            (-ep*(e.xx+0.3*e.zz), -ep*(e.zz+0.3*e.xx)) };
        for pass in 1..=(env("PASSES", 15.0) as usize) {
            let which = if env("DIRECT", 0.0) > 0.0 { Upstream::Downstream } else { Upstream::Given };
            let res = problem.solve(start.clone(), &up, which);
            let down: Vec<[f64;3]> = (0..r).map(|j| [0,1,2].map(|c| res.strain[c][j])).collect();
            let dchange = (0..r).map(|j| { let (x,z)=profile(&down,j); let (x0,z0)=profile(&up,j); (x-x0).abs().max((z-z0).abs()) }).fold(0.0, f64::max);
            let path = res.path.iter().cloned().fold(0.0, f64::max);
            println!("pass {pass}: it {} change {:.2e} dres {:.4e} MPa path {:.3e} t {:?}", res.iterations, res.change, dchange, path, t0.elapsed());
            start = res.strain; up = down;
            if path == 0.0 { break; }
        }
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/reference/shakedown_0.1_1100.csv");
        let text = std::fs::read_to_string(file).unwrap();
        let (mut worst, mut sum, mut cnt) = (0.0f64, 0.0, 0);
        for line in text.lines().skip(1) {
            let v: Vec<f64> = line.split(',').map(|s| s.parse().unwrap()).collect();
            // interpolate ours
            let k = depths.partition_point(|d| *d < v[0] - 1e-9);
            let at = |j: usize| profile(&up, j);
            let (x, z) = if k == 0 { at(0) } else if k >= r { (0.0, 0.0) } else {
                let t = (v[0] - depths[k-1]) / (depths[k] - depths[k-1]);
                let (p, q) = (at(k-1), at(k));
                (p.0 + t*(q.0-p.0), p.1 + t*(q.1-p.1)) };
            if std::env::var("SHOW").is_ok() { println!("{:8.4} {:9.3} {:9.3}  {:9.3} {:9.3}", v[0], v[1], x, v[2], z); }
            worst = worst.max((x-v[1]).abs()).max((z-v[2]).abs());
            sum += (x-v[1]).powi(2) + (z-v[2]).powi(2); cnt += 2;
        }
        println!("worst {worst:.3} rms {:.3} (peak 156.3)", (sum / cnt as f64).sqrt());
    }
}
