//! The running surface under a wheel that feels the cracks, as part of the contact problem.

use super::uncracked_path::{UncrackedPath, UncrackedSurface};
use crate::linear::LinearError;
use crate::math::{Matrix, axpy, dot};

/// A node of the running surface with its hat function ψ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceNode {
    /// Its abscissa x_i, mm.
    pub x: f64,
    /// ∫ψ dx, ∫ψ (x − x_i) dx, ∫ψ (x − x_i)² dx: mm, mm², mm³.
    pub moments: [f64; 3],
}

/// The running surface under a smooth elastic wheel: with nodal pressures q ≥ 0 and the jumps w of
/// the faces, the gap between wheel and rail, weighted with ψ_i, is
///
/// s_i = ∫ψ_i (x − x_c)²/2R dx + (U q)_i + P_n,i · w − δ ∫ψ_i dx ≥ 0,  s_i q_i = 0,
///
/// and the approach δ follows from Σ q_i ∫ψ_i dx = P′. By Betti's theorem the forces P_n of the
/// pressures on the faces also measure how far the jumps lower the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelSurface {
    /// The nodes, in order of x.
    pub nodes: Vec<SurfaceNode>,
    /// U, n × n, mm² per MPa: ∫ψ_i u dx of the uncracked surface for a unit of q_j.
    pub compliance: Matrix,
    /// P_n, n × 2p: row i holds the nodal forces (N/mm per MPa) of a unit of q_i.
    pub measuring: Matrix,
    /// P_μ, n × 2p: the same with the shear that accompanies the pressure everywhere.
    pub loading: Matrix,
    /// The shear beyond it; none in full sliding.
    pub uneven: Option<UnevenShear>,
    /// P′, N/mm.
    pub line_load: f64,
    /// p0 of the uncracked rail, MPa.
    pub peak_pressure: f64,
    /// a of the uncracked rail, mm.
    pub half_width: f64,
    /// R, mm.
    pub radius: f64,
    /// The wheel positions (mm) at which the wheel feels the cracks.
    pub coupled: (f64, f64),
    /// Abscissae of the mouths, mm.
    pub mouths: Vec<f64>,
}

/// Shear that accompanies the pressure by a ratio that depends on the place in the contact.
#[derive(Debug, Clone, PartialEq)]
pub struct UnevenShear {
    /// n × 2p: row i holds the nodal forces (N/mm per MPa) of a unit shear of node i.
    pub forces: Matrix,
    /// Ratios by x − x_c (mm), increasing: linear in between, and constant beyond the first and the
    /// last.
    pub ratios: Vec<(f64, f64)>,
}

/// The value at `u` of `ratios` by abscissa, increasing: linear in between, and constant beyond the
/// first and the last; zero without any.
pub(crate) fn ratio_at(ratios: &[(f64, f64)], u: f64) -> f64 {
    let after = ratios.partition_point(|known| known.0 <= u);
    match (after.checked_sub(1).and_then(|i| ratios.get(i)), ratios.get(after)) {
        (Some(&(from, one)), Some(&(to, other))) => one + (other - one) * (u - from) / (to - from),
        (Some(&(_, ratio)), None) | (None, Some(&(_, ratio))) => ratio,
        (None, None) => 0.0,
    }
}

impl WheelSurface {
    /// The nodes that the mean pressure over |x − `mouth`| ≤ 0.1 a (mm) consists of, each with its
    /// share. The pressure at the very mouth depends on the number of nodes.
    fn mean_over(&self, mouth: f64) -> Vec<(usize, f64)> {
        let lip = LIP * self.half_width;
        let mut shares: Vec<(usize, f64)> = Vec::new();
        let mut add = |node: usize, share: f64| match shares.iter_mut().find(|known| known.0 == node) {
            Some(known) => known.1 += share,
            None => shares.push((node, share)),
        };
        for (i, pair) in self.nodes.windows(2).enumerate() {
            let (a, b) = (pair[0].x, pair[1].x);
            let (start, end) = (a.max(mouth - lip), b.min(mouth + lip));
            if end > start {
                let of_end = (0.5 * (start + end) - a) / (b - a);
                let length = (end - start) / (2.0 * lip);
                add(i, length * (1.0 - of_end));
                add(i + 1, length * of_end);
            }
        }
        shares
    }

    /// The same mean (MPa) of the pressure on the uncracked rail with the wheel at `xc` (mm).
    pub(crate) fn hertz_mean(&self, mouth: f64, xc: f64) -> f64 {
        let lip = LIP * self.half_width;
        // ∫√(1 − u²) du
        let below = |x: f64| {
            let u = ((x - xc) / self.half_width).clamp(-1.0, 1.0);
            0.5 * (u * ((1.0 - u) * (1.0 + u)).sqrt() + u.asin())
        };
        self.peak_pressure * self.half_width * (below(mouth + lip) - below(mouth - lip)) / (2.0 * lip)
    }
}

/// Share of the scales of pressures and gaps that is round-off.
pub(super) const SURFACE_ROUND_OFF: f64 = 1e-10;

/// A [`WheelSurface`] as components of the tableau: the pressures q_i/σ with the gaps σ s_i, and
/// the approach δ/τ with the load equation τ (Σ q_i ∫ψ_i dx − P′).
#[derive(Debug, Clone)]
pub(crate) struct SurfaceSystem {
    pub surface: WheelSurface,
    /// Number of components of the faces.
    faces: usize,
    /// σ and τ, which give these components stiffnesses like those of the faces.
    pressure_unit: f64,
    approach_unit: f64,
    /// Transposed matrix of all components.
    pub columns: Matrix,
    /// Nodal pressures without cracks.
    pub uncracked: UncrackedPath,
}

impl SurfaceSystem {
    /// The system of `surface` with faces of the stiffness A.
    ///
    /// Errors: a surface on which no contact can be found.
    pub fn new(surface: WheelSurface, stiffness: &Matrix) -> Result<Self, LinearError> {
        let none = || Matrix::zeros(surface.nodes.len(), 0);
        let bare = WheelSurface { measuring: none(), loading: none(), uneven: None, ..surface.clone() };
        let bare = Self::assembled(bare, &Matrix::zeros(0, 0), UncrackedPath::default());
        let (pressure, gap) = bare.scales();
        let (first, half_width) = (surface.coupled.0, surface.half_width);
        let uncracked = UncrackedPath::new(UncrackedSurface {
            columns: &bare.columns,
            load: &|xc| bare.load(Vec::new(), xc),
            loaded: surface.nodes.iter().map(|node| (node.x - first).abs() < half_width).collect(),
            range: surface.coupled,
            small: (SURFACE_ROUND_OFF * pressure, SURFACE_ROUND_OFF * gap),
            units: (bare.pressure_unit, bare.approach_unit),
        })?;
        Ok(Self::assembled(surface, stiffness, uncracked))
    }

    fn assembled(surface: WheelSurface, stiffness: &Matrix, uncracked: UncrackedPath) -> Self {
        let (p, n) = (stiffness.rows(), surface.nodes.len());
        let largest = |matrix: &Matrix| (0..matrix.rows()).map(|i| matrix[(i, i)]).fold(0.0f64, f64::max);
        let stiff = if p == 0 { 1.0 } else { largest(stiffness) };
        let pressure_unit = (stiff / largest(&surface.compliance)).sqrt();
        let length = surface.nodes.iter().map(|node| node.moments[0]).fold(0.0f64, f64::max);
        let approach_unit = stiff / (pressure_unit * length);
        let mut columns = Matrix::zeros(p + n + 1, p + n + 1);
        for j in 0..p {
            columns.row_mut(j)[..p].copy_from_slice(stiffness.row(j));
            for i in 0..n {
                columns[(j, p + i)] = pressure_unit * surface.measuring[(i, j)];
            }
        }
        for j in 0..n {
            for k in 0..p {
                columns[(p + j, k)] = -pressure_unit * surface.loading[(j, k)];
            }
            for i in 0..n {
                columns[(p + j, p + i)] = pressure_unit * pressure_unit * surface.compliance[(i, j)];
            }
            let weight = pressure_unit * approach_unit * surface.nodes[j].moments[0];
            columns[(p + j, p + n)] = weight;
            columns[(p + n, p + j)] = -weight;
        }
        Self { surface, faces: p, pressure_unit, approach_unit, columns, uncracked }
    }

    /// Whether the ratio of shear to pressure depends on the place in the contact.
    pub fn is_uneven(&self) -> bool {
        self.surface.uneven.is_some()
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.surface.nodes.len()
    }

    /// The component of node `node`.
    pub fn component(&self, node: usize) -> usize {
        self.faces + node
    }

    /// The component of the approach.
    pub fn approach(&self) -> usize {
        self.faces + self.nodes()
    }

    /// The load on all components with the forces `on_faces` (N/mm) and the wheel at `xc` (mm).
    /// `on_faces` are those of the contact on the uncracked rail; the nodes contribute only what
    /// differs from it.
    pub fn load(&self, mut on_faces: Vec<f64>, xc: f64) -> Vec<f64> {
        for (i, pressure) in self.uncracked.pressures(xc) {
            axpy(-pressure, self.surface.loading.row(i), &mut on_faces[..self.faces]);
        }
        on_faces.resize(self.faces, 0.0);
        let radius = self.surface.radius;
        let gap = |node: &SurfaceNode| {
            let ([length, first, second], d) = (node.moments, node.x - xc);
            (d * d * length + 2.0 * d * first + second) / (2.0 * radius)
        };
        on_faces.extend(self.surface.nodes.iter().map(|node| -self.pressure_unit * gap(node)));
        on_faces.push(self.approach_unit * self.surface.line_load);
        on_faces
    }

    /// The nodal forces on the faces in `load`, with those of the pressures in `jump`.
    pub fn on_faces(&self, load: &[f64], jump: &[f64]) -> Vec<f64> {
        let mut forces = load[..self.faces].to_vec();
        for i in 0..self.nodes() {
            let pressure = self.pressure(jump, i);
            if pressure != 0.0 {
                axpy(pressure, self.surface.loading.row(i), &mut forces);
            }
        }
        forces
    }

    /// The nodal forces on the faces (N/mm, 2p) of the shear that depends on the place in the
    /// contact with the wheel at `xc` (mm), beyond that on the uncracked rail; none in full
    /// sliding.
    pub fn uneven_forces(&self, jump: &[f64], xc: f64) -> Option<Vec<f64>> {
        let uneven = self.surface.uneven.as_ref()?;
        let mut pressures: Vec<f64> = (0..self.nodes()).map(|i| self.pressure(jump, i)).collect();
        self.uncracked.pressures(xc).for_each(|(i, uncracked)| pressures[i] -= uncracked);
        let mut forces = vec![0.0; self.faces];
        for (i, (node, pressure)) in self.surface.nodes.iter().zip(pressures).enumerate() {
            if pressure != 0.0 {
                axpy(pressure * ratio_at(&uneven.ratios, node.x - xc), uneven.forces.row(i), &mut forces);
            }
        }
        Some(forces)
    }

    /// q_i, MPa.
    pub fn pressure(&self, jump: &[f64], node: usize) -> f64 {
        self.pressure_unit * jump[self.faces + node]
    }

    /// s_i / ∫ψ_i dx, mm.
    pub fn gap(&self, contact: &[f64], node: usize) -> f64 {
        contact[self.faces + node] / (self.pressure_unit * self.surface.nodes[node].moments[0])
    }

    /// δ, mm, with the datum of U.
    pub fn approach_of(&self, jump: &[f64]) -> f64 {
        self.approach_unit * jump[self.approach()]
    }

    /// The scales of q_i/σ and σ s_i.
    pub fn scales(&self) -> (f64, f64) {
        let WheelSurface { peak_pressure, half_width, radius, nodes, .. } = &self.surface;
        let length = nodes.iter().map(|node| node.moments[0]).fold(0.0f64, f64::max);
        let gap = half_width * half_width / (2.0 * radius) * length;
        (peak_pressure / self.pressure_unit, gap * self.pressure_unit)
    }

    /// The largest violation of s ≥ 0, q ≥ 0 and s q = 0, relative to their scales.
    pub fn violation(&self, jump: &[f64], contact: &[f64]) -> f64 {
        let (pressure, gap) = self.scales();
        let range = self.faces..self.faces + self.nodes();
        let pairs = jump[range.clone()].iter().zip(&contact[range]);
        pairs.fold(0.0f64, |worst, (q, s)| {
            let (q, s) = (q / pressure, s / gap);
            worst.max(-q).max(-s).max(q.min(s))
        })
    }

    /// The contact with the components `jump` and the nodes `loaded` in contact, the wheel at `xc`
    /// (mm) and mouths at `mouths` (mm); `None` where the wheel is not coupled. `punch` are the
    /// nodal forces on the faces (1, 2p) per increment of the line load on the uncracked rail.
    pub fn state(
        &self,
        (jump, loaded): (&[f64], &[bool]),
        xc: f64,
        (mouths, punch): (&[Option<f64>], &[f64]),
    ) -> Option<CoupledState> {
        let (from, to) = self.extent(loaded)?;
        let lip = LIP * self.surface.half_width;
        Some(CoupledState {
            approach: self.approach_of(jump) - self.uncracked.approach(xc)
                + self.sinking_under(punch, jump, xc),
            from,
            to,
            lip_loads: mouths.iter().map(|mouth| mouth.map(|x| 2.0 * lip * self.mean(jump, x))).collect(),
        })
    }

    /// How much more the jumps lower the wheel than the nodal pressures measure, mm.
    ///
    /// The load on the faces is e + P q, with e = F − P q_u the Hertzian load F beyond its nodal
    /// pressures. The energy of wheel and rail is stationary, so that the approach as its
    /// derivative with respect to the line load is δ + w · ∂e/∂P′.
    fn sinking_under(&self, punch: &[f64], jump: &[f64], xc: f64) -> f64 {
        let jump = &jump[..self.faces];
        let of_nodes = |(i, rise): (usize, f64)| rise * dot(self.surface.measuring.row(i), jump);
        dot(punch, jump) - self.uncracked.rises(xc).map(of_nodes).sum::<f64>()
    }

    /// All nodes with the components `jump` and `contact`.
    pub fn surface_states(&self, jump: &[f64], contact: &[f64]) -> Vec<SurfaceState> {
        let state = |i: usize| SurfaceState {
            x: self.surface.nodes[i].x,
            pressure: self.pressure(jump, i),
            gap: self.gap(contact, i),
        };
        (0..self.nodes()).map(state).collect()
    }

    /// Abscissae (mm) of the first and the last of the nodes `loaded`; none without contact.
    pub fn extent(&self, loaded: &[bool]) -> Option<(f64, f64)> {
        let at = |node: usize| self.surface.nodes[node].x;
        let first = loaded.iter().position(|&loaded| loaded)?;
        let last = loaded.iter().rposition(|&loaded| loaded)?;
        Some((at(first), at(last)))
    }

    /// The mean pressure (MPa) over 0.1 a on either side of `mouth` (mm).
    pub fn mean(&self, jump: &[f64], mouth: f64) -> f64 {
        self.surface.mean_over(mouth).into_iter().map(|(i, share)| share * self.pressure(jump, i)).sum()
    }
}

/// Distance from a mouth, over a, within which the contact load counts as that on its lips, and
/// over which the pressure of fluid from the mouth is the mean.
const LIP: f64 = 0.1;

/// The contact of a wheel that feels the cracks.
#[derive(Debug, Clone, PartialEq)]
pub struct CoupledState {
    /// How much farther the wheel approaches than on the uncracked rail, mm: the derivative of the
    /// energy of wheel and rail with respect to the line load.
    pub approach: f64,
    /// Abscissa of the first surface node under pressure, mm.
    pub from: f64,
    /// Abscissa of the last one, mm.
    pub to: f64,
    /// Load (N/mm) within 0.1 a of the mouth of the crack of each tip; `None` for buried cracks.
    pub lip_loads: Vec<Option<f64>>,
}

/// A node of the running surface under a wheel that feels the cracks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceState {
    /// Its abscissa, mm.
    pub x: f64,
    /// Pressure, MPa.
    pub pressure: f64,
    /// Mean gap between wheel and rail over its hat function, mm.
    pub gap: f64,
}
