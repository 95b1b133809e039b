//! Parts of a long row of cracks, and the blocks that the row takes from them.

use super::error::XfemError;
use super::junctions::junctions_on;
use crate::body::{BodyTimes, CrackedBody, FaceElement, FacePoint, FaceSample};
use crate::crack::{CrackCurve, CrackEnd, CrackNetwork, CrackTip, Junction};
use crate::linear::{LinearError, product};
use crate::math::Matrix;
use crate::nuclei::{Source, SourceSite, Units};
use std::ops::Range;

/// Some units of a row as a separate network.
pub(super) struct PartOfRow {
    pub network: CrackNetwork,
    /// Its cracks in the row.
    cracks: Vec<usize>,
    units: Range<usize>,
    /// The unit in the row of each of its cracks.
    unit_of: Vec<usize>,
}

/// A unit in the part from which it is taken; points are numbered within their unit.
pub(super) struct UnitOfPart {
    /// Its face points, with cracks numbered in the row.
    pub points: Vec<FacePoint>,
    /// Quadrature points with the crack in the row.
    pub samples: Vec<(usize, FaceSample)>,
    pub tips: Vec<TipOfPart>,
    /// Elements, with cracks numbered in the row.
    elements: Vec<FaceElement>,
}

/// A tip in the part from which its unit is taken.
pub(super) struct TipOfPart {
    pub tip: CrackEnd,
    /// Unit of the row, and point of the unit, with its [`crate::body::TipGain`].
    pub gains: Vec<(usize, usize, [[f64; 2]; 2])>,
    pub remarks: Vec<String>,
}

/// The matrices and faces that are taken from a part.
pub(super) struct Taken {
    /// A between units k ≤ l of the row.
    pub pairs: Vec<((usize, usize), Matrix)>,
    pub units: Vec<(usize, UnitOfPart)>,
    pub times: BodyTimes,
    pub dofs: usize,
}

impl PartOfRow {
    /// The units `own` of `network`.
    pub(crate) fn new(network: &CrackNetwork, units: &Units, own: Range<usize>) -> Self {
        let mut cracks: Vec<usize> = units.cracks[own.clone()].concat();
        cracks.sort_unstable();
        let number = |crack: usize| cracks.binary_search(&crack).ok();
        let junction = |junction: &Junction| {
            let joining = CrackEnd { crack: number(junction.joining.crack)?, ..junction.joining };
            Some(Junction { joining, onto: number(junction.onto)? })
        };
        let junctions = network.junctions().iter().filter_map(junction).collect();
        let of_row = units.of_cracks();
        let own_cracks = cracks.iter().map(|&crack| network.cracks()[crack].clone()).collect();
        Self {
            network: CrackNetwork::joined(own_cracks, junctions).expect("whole units of a network"),
            unit_of: cracks.iter().map(|&crack| of_row[crack]).collect(),
            cracks,
            units: own,
        }
    }

    /// The index in the row of crack `crack`, from 0.
    pub(crate) fn number(&self, crack: usize) -> usize {
        self.cracks[crack]
    }

    /// The unit in the row of crack `crack`.
    pub(crate) fn unit(&self, crack: usize) -> usize {
        self.unit_of[crack]
    }

    /// The `error` with its crack numbered in the row.
    pub(crate) fn in_row(&self, error: XfemError) -> XfemError {
        match error {
            XfemError::OutsideMesh { crack, covered, length } => {
                XfemError::OutsideMesh { crack: self.cracks[crack - 1] + 1, covered, length }
            }
            error => error,
        }
    }

    /// The units and pairs of the `body` of this part that are `at_home` in it, with its `elements`
    /// and the `remarks` on its tips.
    pub(crate) fn taken(
        &self,
        body: &CrackedBody,
        elements: &[FaceElement],
        remarks: &[Vec<String>],
        at_home: &dyn Fn(usize, usize) -> bool,
    ) -> Result<Taken, LinearError> {
        // The points of each unit, and the index of each point among them.
        let mut points: Vec<Vec<usize>> = vec![Vec::new(); self.units.len()];
        let mut place = Vec::new();
        for (i, point) in body.faces.points.iter().enumerate() {
            let own = &mut points[self.unit_of[point.crack] - self.units.start];
            place.push(own.len());
            own.push(i);
        }
        let of_unit = |k: usize| &points[k - self.units.start];
        let pairs = self.units.clone().flat_map(|k| (k..self.units.end).map(move |l| (k, l)));
        let block = |(k, l): (usize, usize)| {
            let (rows, columns) = (of_unit(k), of_unit(l));
            let entry =
                |i: usize, j: usize| body.stiffness[(2 * rows[i / 2] + i % 2, 2 * columns[j / 2] + j % 2)];
            ((k, l), Matrix::from_fn(2 * rows.len(), 2 * columns.len(), entry))
        };
        let pairs = pairs.filter(|&(k, l)| at_home(k, l)).map(block).collect();
        let gains = product(&body.sif_influence, &body.stiffness)?;
        let crack_of = |sample: &FaceSample| {
            let (point, _) = sample.shares.iter().find(|share| share.1 != 0.0)?;
            Some(body.faces.points[*point].crack)
        };
        let unit = |k: usize| {
            let own = |crack: usize| self.unit_of[crack] == k;
            let tip = |(number, tip): (usize, &CrackTip)| TipOfPart {
                tip: CrackEnd { crack: self.cracks[tip.crack], end: tip.end },
                gains: body
                    .faces
                    .points
                    .iter()
                    .enumerate()
                    .map(|(p, point)| {
                        let gain = |mode, component| gains[(2 * number + mode, 2 * p + component)];
                        let of_mode = |mode| [gain(mode, 0), gain(mode, 1)];
                        (self.unit_of[point.crack], place[p], [of_mode(0), of_mode(1)])
                    })
                    .collect(),
                remarks: remarks[number].clone(),
            };
            let sample = |sample: &FaceSample| {
                let crack = crack_of(sample).filter(|&crack| own(crack))?;
                let shares = sample.shares.map(|(point, length)| (place[point], length));
                Some((self.cracks[crack], FaceSample { shares, ..*sample }))
            };
            let element = |element: &FaceElement| {
                let mut element = element.clone();
                element.ends = element.ends.map(|end| end.map(|point| place[point]));
                element.pieces.iter_mut().for_each(|piece| piece.crack = self.cracks[piece.crack]);
                element.crack = self.cracks[element.crack];
                element
            };
            let in_row = |&p: &usize| {
                let point = body.faces.points[p];
                FacePoint { crack: self.cracks[point.crack], ..point }
            };
            let taken = UnitOfPart {
                points: of_unit(k).iter().map(in_row).collect(),
                samples: body.faces.samples.iter().filter_map(sample).collect(),
                tips: body.tips.iter().enumerate().filter(|(_, tip)| own(tip.crack)).map(tip).collect(),
                elements: elements.iter().filter(|e| own(e.crack)).map(element).collect(),
            };
            (k, taken)
        };
        let units = self.units.clone().filter(|&k| at_home(k, k)).map(unit).collect();
        Ok(Taken { pairs, units, times: body.times, dofs: body.dofs })
    }
}

impl UnitOfPart {
    /// The dislocations of this unit of `network`, whose cracks have the `curves`.
    pub(crate) fn sources(&self, network: &CrackNetwork, curves: &[CrackCurve]) -> Vec<Source<'_>> {
        let mut sources = Vec::new();
        for element in &self.elements {
            let ends = element.ends.iter().zip([-1.0, 1.0]);
            let follows: Vec<(usize, f64)> =
                ends.clone().filter_map(|(end, sign)| Some(((*end)?, sign))).collect();
            sources.push(Source { place: SourceSite::Element(element), follows });
            // The jump on an arm of a junction ends with the arm.
            let crack = element.crack;
            let curve = &curves[crack];
            let vertices = curve.vertices();
            for vertex in junctions_on(network, crack) {
                let g = vertices[vertex];
                for ((end, sign), range) in ends.clone().zip([element.range.0, element.range.1]) {
                    if let (true, Some(point)) = (range == g, *end) {
                        let at = network.cracks()[crack].points()[vertex];
                        sources.push(Source {
                            place: SourceSite::Point { crack, at },
                            follows: vec![(point, -sign)],
                        });
                    }
                }
            }
        }
        sources
    }
}
