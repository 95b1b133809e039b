//! Ranges of K of a straight crack over its length, for many runs of one rail: at other speeds,
//! under other grinding.

use super::rail::{PlaneBody, PlaneRail, PlaneSite, movers};
use super::tip_under_wheel::TipUnderWheel;
use crate::crack::{Crack, CrackError, CrackNetwork, CrackTip, End};
use crate::growth::{
    Advance, BodyReport, CrackedRail, FieldRecord, Geometry, GrowthError, GrowthSettings, GrowthState, Mover,
    Observer, PlaneGeometry, PlaneTip, StabilisedPassage, StepStart, TipRecord, Warning, WheelOfRail,
};
use crate::interruption::Interruption;
use crate::math::{Vec2, lagrange};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Distance of the logarithms of two lengths at which K is computed.
const APART: f64 = 0.06;
/// Angle (radians) up to which segments are one straight line.
const STRAIGHT: f64 = 1e-6;

/// A straight surface crack of a rail under its wheels, over its length: K is computed where it
/// is asked for, at lengths that do not depend on who asks, and interpolated by cubics between
/// them. In a half-plane without a profile of residual stress nothing else matters to K, but for
/// the positions of the wheel, which are those about the mouth at the beginning: wear and grinding
/// leave a shorter crack with the same tip.
pub struct KnownStraight {
    /// The crack at the beginning.
    first: Crack,
    /// By the number of steps of [`APART`] from its length.
    nodes: Mutex<BTreeMap<i32, Option<Arc<Node>>>>,
}

/// A crack of a given length under the stabilised passage of each wheel.
struct Node {
    tips: Vec<TipUnderWheel>,
    record: TipRecord,
    /// Of the faces the points, and their states where they are widest open.
    passages: Vec<StabilisedPassage>,
}

/// A crack between nodes.
struct Between {
    under_wheels: Vec<TipUnderWheel>,
    /// The nearest of them.
    near: Arc<Node>,
}

impl KnownStraight {
    /// For the crack of `network`; none unless that is a single straight surface crack which goes
    /// straight ahead at first by the settings of `growth`.
    #[must_use]
    pub fn of(network: &CrackNetwork, growth: &GrowthSettings) -> Option<Self> {
        let [first] = network.cracks() else { return None };
        let is_surface = first.is_surface_breaking() && is_straight(first, first.ahead(End::Last));
        let known = Self { first: first.clone(), nodes: Mutex::default() };
        Some(known).filter(|known| is_surface && known.is_straight(first.length(), growth))
    }

    /// Whether the crack goes straight ahead when it is `length` (mm) long.
    fn is_straight(&self, length: f64, growth: &GrowthSettings) -> bool {
        growth.is_straight_at(-self.first.ahead(End::Last).y * length)
    }

    /// The length of the crack of `geometry`, mm; none where that is another one.
    fn length_of(&self, geometry: &PlaneGeometry) -> Option<f64> {
        let [crack] = geometry.cracks.as_slice() else { return None };
        let has_others = !geometry.junctions.is_empty() || !geometry.break_outs.is_empty();
        let is_it = crack.is_surface_breaking() && is_straight(crack, self.first.ahead(End::Last));
        (is_it && !has_others).then(|| crack.length() + geometry.deferred_at(0))
    }

    /// The crack when its length was that of `node`, with its mouth where it was at the beginning.
    fn crack(&self, node: i32) -> Result<Crack, CrackError> {
        let [mouth, ahead] = [self.first.points()[0], self.first.ahead(End::Last)];
        Crack::polyline(vec![mouth, mouth + ahead * self.length(node)])
    }

    /// The length of `node`, mm.
    fn length(&self, node: i32) -> f64 {
        self.first.length() * (APART * f64::from(node)).exp()
    }

    /// The tip of a crack of `length` (mm) under each wheel between nodes, of which those that are
    /// not known yet are computed by `at`, and the nearest of these; none where one of them cannot
    /// be computed.
    ///
    /// Errors: an interruption.
    fn between(
        &self,
        length: f64,
        mut at: impl FnMut(i32) -> Result<Option<Node>, GrowthError>,
    ) -> Result<Option<Between>, GrowthError> {
        let place = (length / self.first.length()).ln() / APART;
        let first = place.floor() as i32 - 1;
        let mut nodes = Vec::with_capacity(4);
        for node in first..first + 4 {
            let Some(known) = self.node(node, &mut at)? else { return Ok(None) };
            nodes.push(known);
        }
        let places: Vec<f64> = (first..first + 4).map(f64::from).collect();
        let (_, weights) = lagrange(&places, place);
        let near = usize::from(place - place.floor() > 0.5) + 1;
        let of_wheel = |wheel: usize| {
            let all: Vec<TipUnderWheel> = nodes.iter().map(|node| node.tips[wheel]).collect();
            TipUnderWheel::between(&all, &weights, near)
        };
        let under_wheels = (0..nodes[near].tips.len()).map(of_wheel).collect();
        Ok(Some(Between { under_wheels, near: Arc::clone(&nodes[near]) }))
    }

    fn node(
        &self,
        node: i32,
        at: &mut impl FnMut(i32) -> Result<Option<Node>, GrowthError>,
    ) -> Result<Option<Arc<Node>>, GrowthError> {
        let nodes = || self.nodes.lock().unwrap_or_else(PoisonError::into_inner);
        let known = nodes().get(&node).cloned();
        match known {
            Some(known) => Ok(known),
            // Computed twice where two runs ask for it at once: whoever waited could be asked to
            // work for the other meanwhile.
            None => {
                let made = at(node)?.map(Arc::new);
                nodes().insert(node, made.clone());
                Ok(made)
            }
        }
    }
}

/// Whether all segments of `crack` lead along `ahead`.
fn is_straight(crack: &Crack, ahead: Vec2) -> bool {
    crack.points().windows(2).all(|pair| {
        let along = (pair[1] - pair[0]).normalised();
        ahead.cross(along).abs() <= STRAIGHT && ahead.dot(along) > 0.0
    })
}

/// A rail whose straight crack is known as far as some run has needed it; everything else is
/// computed.
pub struct KnownRail {
    rail: PlaneRail,
    known: Arc<KnownStraight>,
}

impl KnownRail {
    /// `rail` with what is `known` of its crack.
    #[must_use]
    pub fn new(rail: PlaneRail, known: Arc<KnownStraight>) -> Self {
        Self { rail, known }
    }

    /// The tip under each wheel, where the crack of `state` goes straight and is known.
    ///
    /// Errors: an interruption.
    fn tip(
        &mut self,
        state: &GrowthState,
        interruption: Interruption<'_>,
    ) -> Result<Option<KnownCrack>, GrowthError> {
        let Geometry::Plane(geometry) = &state.geometry else { return Ok(None) };
        let Self { rail, known } = self;
        let is_straight = |length: &f64| known.is_straight(*length, &rail.growth);
        let Some(length) = known.length_of(geometry).filter(is_straight) else { return Ok(None) };
        let tip = CrackTip { crack: 0, tip: 0, end: End::Last };
        let at = |node: i32| rail.node(known.crack(node), interruption);
        let Some(Between { under_wheels, near }) = known.between(length, at)? else { return Ok(None) };
        // Nothing of how a run would turn there.
        let plane = near.record.plane().copied().unwrap_or_default();
        let plane = PlaneTip {
            deferred: geometry.deferred[0][0],
            jump: None,
            sensitivity: 0.0,
            kink_slope: 0.0,
            ..plane
        };
        let record = rail.tip_record(geometry, tip, &under_wheels, near.record.kink, plane);
        let network = CrackNetwork::new(geometry.cracks.clone()).ok();
        Ok(network.map(|network| KnownCrack { geometry: geometry.clone(), network, record, near }))
    }
}

impl PlaneRail {
    /// The tip of `crack` under each wheel; none where that cannot be computed.
    ///
    /// Errors: an interruption.
    fn node(
        &mut self,
        crack: Result<Crack, CrackError>,
        interruption: Interruption<'_>,
    ) -> Result<Option<Node>, GrowthError> {
        struct Asked<'a>(Interruption<'a>);
        impl Observer for Asked<'_> {
            fn progress(&self, _: f64) {}

            fn interrupted(&self) -> bool {
                self.0.asked()
            }
        }
        let Some(network) = crack.ok().and_then(|crack| CrackNetwork::new(vec![crack]).ok()) else {
            return Ok(None);
        };
        let state = GrowthState::initial(&network);
        let loaded = self.body(&state, interruption).and_then(|body| {
            let at = StepStart::standing(&state.worn);
            Ok((self.passages(&body, &at, &Asked(interruption), &mut Vec::new())?, body))
        });
        match loaded {
            Ok((passages, body)) => Ok(Node::of(self.demands(&body, &passages), passages)),
            Err(error) if error.is_interruption() => Err(error),
            Err(_) => Ok(None),
        }
    }
}

impl Node {
    /// The only one of `tips` under the `passages` of all wheels.
    fn of(tips: Vec<TipRecord>, mut passages: Vec<StabilisedPassage>) -> Option<Self> {
        let [record] = tips.try_into().ok()?;
        let of_wheel = |passage: &StabilisedPassage| passage.histories.first().map(TipUnderWheel::of);
        let tips = passages.iter().map(of_wheel).collect::<Option<_>>()?;
        passages.iter_mut().for_each(StabilisedPassage::keep_widest);
        Some(Self { tips, record, passages })
    }
}

/// A step of a crack that is known.
pub struct KnownCrack {
    geometry: PlaneGeometry,
    network: CrackNetwork,
    record: TipRecord,
    near: Arc<Node>,
}

/// The cracks of a step.
pub enum KnownBody {
    /// As a body.
    Computed(Box<PlaneBody>),
    /// By their tip.
    Known(Box<KnownCrack>),
}

impl CrackedRail for KnownRail {
    type Body = KnownBody;
    type Site = PlaneSite;

    fn settings(&self) -> &GrowthSettings {
        self.rail.settings()
    }

    fn wheels(&self) -> Vec<WheelOfRail<'_>> {
        self.rail.wheels()
    }

    fn refinement(&self) -> &'static str {
        self.rail.refinement()
    }

    fn body(
        &mut self,
        state: &GrowthState,
        interruption: Interruption<'_>,
    ) -> Result<KnownBody, GrowthError> {
        Ok(match self.tip(state, interruption)? {
            Some(crack) => KnownBody::Known(Box::new(crack)),
            None => KnownBody::Computed(Box::new(self.rail.body(state, interruption)?)),
        })
    }

    fn report(&self, body: &KnownBody) -> BodyReport {
        match body {
            KnownBody::Computed(body) => self.rail.report(body),
            KnownBody::Known(_) => BodyReport::default(),
        }
    }

    fn passages(
        &mut self,
        body: &KnownBody,
        at: &StepStart<'_>,
        observer: &dyn Observer,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<StabilisedPassage>, GrowthError> {
        match body {
            KnownBody::Computed(body) => self.rail.passages(body, at, observer, warnings),
            KnownBody::Known(crack) => Ok(crack.near.passages.clone()),
        }
    }

    fn fields(
        &mut self,
        body: &KnownBody,
        at: &StepStart<'_>,
        passage: &StabilisedPassage,
    ) -> Result<Option<FieldRecord>, GrowthError> {
        match body {
            KnownBody::Computed(body) => self.rail.fields(body, at, passage),
            KnownBody::Known(_) => Ok(None),
        }
    }

    fn demands(&self, body: &KnownBody, passages: &[StabilisedPassage]) -> Vec<TipRecord> {
        match body {
            KnownBody::Computed(body) => self.rail.demands(body, passages),
            KnownBody::Known(crack) => vec![crack.record],
        }
    }

    fn movers(&self, _: &KnownBody, tips: &[TipRecord]) -> Vec<Mover> {
        movers(tips)
    }

    fn site(&self, body: &KnownBody) -> PlaneSite {
        match body {
            KnownBody::Computed(body) => self.rail.site(body),
            KnownBody::Known(crack) => self.rail.site_of(&crack.geometry, &crack.network),
        }
    }

    fn advance(
        &self,
        site: &PlaneSite,
        at: &StepStart<'_>,
        tips: &mut [TipRecord],
        movers: &[Mover],
    ) -> Advance {
        self.rail.advance(site, at, tips, movers)
    }

    fn hazard(&self, site: &PlaneSite, tip: &TipRecord) -> f64 {
        self.rail.hazard(site, tip)
    }

    fn popped_in(&self, site: &PlaneSite, tips: &[&TipRecord], length: f64) -> Option<Geometry> {
        self.rail.popped_in(site, tips, length)
    }

    fn forget(&mut self) {
        self.rail.forget();
    }
}
