//! Time marching: the same material on a fixed mesh of finite elements, over which the wheel moves
//! in small steps. It shares the closed-form stress of the wheel with the library, and nothing
//! else.
//!
//! The mesh is periodic: the first column follows the last. So the whole length is rolled, without
//! the ends of a rolled piece nearby; a free rail of some half-widths would be bent by them.

use railcrack::field::HertzField;
use railcrack::math::Vec2;
use railcrack::shakedown::RolledRail;

/// The mesh and the steps, in half-widths of the contact.
#[derive(Debug, Clone, Copy)]
pub struct March {
    /// Elements per half-width near the middle.
    pub per_half_width: f64,
    /// Wheel steps per half-width.
    pub steps: f64,
    /// The wheel runs from − to + this.
    pub run: f64,
    /// Evenly meshed depth.
    pub fine_depth: f64,
}

/// Residual stress under the middle of the rail after each passage: (depth mm, σ_xx, σ_zz MPa) by
/// element.
pub type Profile = Vec<(f64, f64, f64)>;

/// Result of the time marching.
pub struct Marched {
    pub profiles: Vec<Profile>,
    /// Solutions of the elastic system.
    pub solutions: usize,
}

/// Half-length of the even part of the mesh, and depth of the mesh, in half-widths.
const EVEN: f64 = 2.0;
const DEEP: f64 = 12.0;
/// Gauss points of an element.
const POINTS: usize = 4;
/// Change of the plastic strain at which the iteration of a step ends, times 2 G over the radius of
/// the yield surface.
const TOLERANCE: f64 = 1e-4;

struct Element {
    dofs: [usize; 8],
    /// Strain deviator (three components of unit metric) at the Gauss points.
    deviator: [[[f64; 8]; 3]; POINTS],
    /// Mean dilatation (B-bar: plastic flow is incompressible).
    dilatation: [f64; 8],
    weight: f64,
    points: [Vec2; POINTS],
}

/// Rolls `passes` times over `rail`.
pub fn march(rail: &RolledRail, mesh: March, passes: usize) -> Marched {
    let a = rail.contact.half_width();
    let h = a / mesh.per_half_width;
    let xs = abscissae(h, EVEN * a, mesh.run * a);
    let ys = depths(h, mesh.fine_depth * a, DEEP * a);
    let (shear, poisson) = (rail.steel.shear_modulus(), rail.steel.poisson());
    let bulk = rail.steel.young() / (3.0 * (1.0 - 2.0 * poisson));
    let rows = ys.len();
    let elements: Vec<Element> = (0..xs.len() - 1)
        .flat_map(|i| (0..rows - 1).map(move |j| (i, j)))
        .map(|(i, j)| {
            let columns = [place(i, xs.len() - 1), place((i + 1) % (xs.len() - 1), xs.len() - 1)];
            element([xs[i], xs[i + 1]], [-ys[j + 1], -ys[j]], columns, j, rows)
        })
        .collect();
    let size = 2 * (xs.len() - 1) * rows;
    let mut system = Band::new(size, 4 * rows + 4);
    for e in &elements {
        for p in 0..8 {
            for q in 0..8 {
                let mut k = bulk * POINTS as f64 * e.weight * e.dilatation[p] * e.dilatation[q];
                for d in &e.deviator {
                    k += 2.0 * shear * e.weight * (0..3).map(|c| d[c][p] * d[c][q]).sum::<f64>();
                }
                system.add(e.dofs[p], e.dofs[q], k);
            }
        }
    }
    for i in 0..xs.len() - 1 {
        for c in 0..2 {
            system.hold(2 * (i * rows + rows - 1) + c);
        }
    }
    system.factor();
    let (radius, back) = (rail.hardening.yield_radius(), rail.hardening.back_stress_modulus());
    let field = HertzField::new(rail.contact.sliding().unwrap(), poisson);
    let mut strain = vec![[[0.0; 3]; POINTS]; elements.len()];
    let mut displacement = vec![0.0; size];
    let (mut profiles, mut solutions) = (Vec::new(), 0);
    let count = (2.0 * mesh.run * mesh.steps).round() as usize;
    for _ in 0..passes {
        for step in 0..=count {
            let xc = a * (-mesh.run + step as f64 / mesh.steps);
            let wheel: Vec<[[f64; 3]; POINTS]> =
                elements.iter().map(|e| e.points.map(|p| field.stress(p, xc).deviator())).collect();
            let before = strain.clone();
            loop {
                let mut change = 0.0_f64;
                for (n, e) in elements.iter().enumerate() {
                    for g in 0..POINTS {
                        let total = [0, 1, 2].map(|c| {
                            (0..8).map(|p| e.deviator[g][c][p] * displacement[e.dofs[p]]).sum::<f64>()
                        });
                        let xi = [0, 1, 2].map(|c| {
                            wheel[n][g][c] + 2.0 * shear * total[c] - (2.0 * shear + back) * before[n][g][c]
                        });
                        let size = xi.iter().map(|x| x * x).sum::<f64>().sqrt();
                        let flow = (size - radius).max(0.0) / ((2.0 * shear + back) * size);
                        for c in 0..3 {
                            let new = before[n][g][c] + flow * xi[c];
                            change = change.max((new - strain[n][g][c]).abs());
                            strain[n][g][c] = new;
                        }
                    }
                }
                if change * 2.0 * shear <= TOLERANCE * radius {
                    break;
                }
                displacement.fill(0.0);
                for (n, e) in elements.iter().enumerate() {
                    for g in 0..POINTS {
                        for p in 0..8 {
                            let power: f64 = (0..3).map(|c| e.deviator[g][c][p] * strain[n][g][c]).sum();
                            displacement[e.dofs[p]] += 2.0 * shear * e.weight * power;
                        }
                    }
                }
                system.solve(&mut displacement);
                solutions += 1;
            }
        }
        profiles.push(profile(&elements, &strain, &displacement, &ys, [shear, bulk]));
    }
    Marched { profiles, solutions }
}

/// The number in the system of column `i` of `columns` in a ring, such that neighbours in the ring
/// are close.
fn place(i: usize, columns: usize) -> usize {
    if i < columns.div_ceil(2) { 2 * i } else { 2 * (columns - 1 - i) + 1 }
}

/// Boundaries of the columns: even with x = 0 in the middle of one, up to `even`; growing beyond,
/// up to `end`.
fn abscissae(h: f64, even: f64, end: f64) -> Vec<f64> {
    let mut right = vec![0.5 * h];
    let mut next = h;
    while right[right.len() - 1] < end {
        let last = right[right.len() - 1];
        if last > even {
            next *= 1.05;
        }
        right.push(last + next);
    }
    right.iter().rev().map(|x| -x).chain(right.iter().copied()).collect()
}

fn depths(h: f64, fine: f64, end: f64) -> Vec<f64> {
    let mut depths = vec![0.0];
    let mut next = h;
    while depths[depths.len() - 1] < end {
        let last = depths[depths.len() - 1];
        if last >= fine {
            next *= 1.3;
        }
        depths.push(last + next);
    }
    depths
}

fn element(x: [f64; 2], y: [f64; 2], [left, right]: [usize; 2], j: usize, rows: usize) -> Element {
    // Row j is the upper boundary: nodes 3 and 2; y[0] is the lower one.
    let nodes = [left * rows + j + 1, right * rows + j + 1, right * rows + j, left * rows + j];
    let (w, h) = (x[1] - x[0], y[1] - y[0]);
    let mut e = Element {
        dofs: [0, 1, 2, 3, 4, 5, 6, 7].map(|p| 2 * nodes[p / 2] + p % 2),
        deviator: [[[0.0; 8]; 3]; POINTS],
        dilatation: [0.0; 8],
        weight: w * h / POINTS as f64,
        points: [Vec2::new(0.0, 0.0); POINTS],
    };
    let gauss = [0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt()];
    for g in 0..POINTS {
        let (s, t) = (gauss[g % 2], gauss[g / 2]);
        e.points[g] = Vec2::new(x[0] + s * w, y[0] + t * h);
        let dx = [-(1.0 - t) / w, (1.0 - t) / w, t / w, -t / w];
        let dy = [-(1.0 - s) / h, -s / h, s / h, (1.0 - s) / h];
        for n in 0..4 {
            let r2 = 2f64.sqrt();
            let out = -(1.5f64.sqrt()) / 3.0;
            for (c, (along, down)) in
                [(dx[n] / r2, -dy[n] / r2), (out * dx[n], out * dy[n]), (dy[n] / r2, dx[n] / r2)]
                    .into_iter()
                    .enumerate()
            {
                (e.deviator[g][c][2 * n], e.deviator[g][c][2 * n + 1]) = (along, down);
            }
            e.dilatation[2 * n] += dx[n] / POINTS as f64;
            e.dilatation[2 * n + 1] += dy[n] / POINTS as f64;
        }
    }
    e
}

fn profile(
    elements: &[Element],
    strain: &[[[f64; 3]; POINTS]],
    displacement: &[f64],
    ys: &[f64],
    [shear, bulk]: [f64; 2],
) -> Profile {
    let rows = ys.len() - 1;
    let middle = elements.len() / rows / 2;
    let of = |j: usize| {
        let e = &elements[middle * rows + j];
        let u: Vec<f64> = e.dofs.iter().map(|&dof| displacement[dof]).collect();
        let mean = bulk * (0..8).map(|p| e.dilatation[p] * u[p]).sum::<f64>();
        let (mut xx, mut zz) = (mean, mean);
        for g in 0..POINTS {
            let s = [0, 1, 2].map(|c| {
                let total = (0..8).map(|p| e.deviator[g][c][p] * u[p]).sum::<f64>();
                2.0 * shear * (total - strain[middle * rows + j][g][c]) / POINTS as f64
            });
            let out = (2.0 / 3.0_f64).sqrt() * s[1];
            zz += out;
            xx += s[0] / 2f64.sqrt() - 0.5 * out;
        }
        (0.5 * (ys[j] + ys[j + 1]), xx, zz)
    };
    (0..rows).map(of).collect()
}

/// A symmetric band matrix and its Cholesky factor.
struct Band {
    width: usize,
    /// Row i holds columns i − width to i.
    rows: Vec<f64>,
    size: usize,
    held: Vec<usize>,
}

impl Band {
    fn new(size: usize, width: usize) -> Self {
        Self { width, rows: vec![0.0; size * (width + 1)], size, held: Vec::new() }
    }

    fn at(&self, i: usize, j: usize) -> usize {
        i * (self.width + 1) + self.width + j - i
    }

    fn add(&mut self, i: usize, j: usize, value: f64) {
        if j <= i {
            let at = self.at(i, j);
            self.rows[at] += value;
        }
    }

    /// Holds a displacement at zero: a spring far stiffer than the body.
    fn hold(&mut self, i: usize) {
        let at = self.at(i, i);
        self.rows[at] += 1e12;
        self.held.push(i);
    }

    fn factor(&mut self) {
        for i in 0..self.size {
            let first = i.saturating_sub(self.width);
            for j in first..=i {
                let from = first.max(j.saturating_sub(self.width));
                let (a, b, n) = (self.at(i, from), self.at(j, from), j - from);
                let sum: f64 = self.rows[a..a + n].iter().zip(&self.rows[b..b + n]).map(|(x, y)| x * y).sum();
                let (here, pivot) = (self.at(i, j), self.at(j, j));
                let rest = self.rows[here] - sum;
                self.rows[here] = if i == j { rest.sqrt() } else { rest / self.rows[pivot] };
            }
        }
    }

    fn solve(&self, x: &mut [f64]) {
        for i in 0..self.size {
            let first = i.saturating_sub(self.width);
            let at = self.at(i, first);
            let sum: f64 = self.rows[at..at + i - first].iter().zip(&x[first..i]).map(|(l, x)| l * x).sum();
            x[i] = (x[i] - sum) / self.rows[self.at(i, i)];
        }
        for i in (0..self.size).rev() {
            let first = i.saturating_sub(self.width);
            let at = self.at(i, first);
            x[i] /= self.rows[self.at(i, i)];
            let value = x[i];
            for (l, x) in self.rows[at..at + i - first].iter().zip(&mut x[first..i]) {
                *x -= l * value;
            }
        }
    }
}
