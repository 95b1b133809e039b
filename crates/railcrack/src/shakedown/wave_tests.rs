//! Laws that every wave obeys, in the plane of its direction and across it.

use super::super::antiplane::{Antiplane, AntiplaneWave};
use super::super::in_plane::{InPlane, PlaneWave};
use super::*;

fn layers(wave_number: f64) -> Vec<LayerFactors> {
    let mut top = 0.0;
    let of = |h: f64| {
        let layer = LayerFactors::new(wave_number, top, h);
        top += h;
        layer
    };
    [0.3, 0.2, 0.5, 0.1, 0.7].into_iter().map(of).collect()
}

/// A wave with any strain, another one for every `seed`.
fn example<E: Effect<N, T>, const N: usize, const T: usize>(
    layers: &[LayerFactors],
    seed: f64,
) -> Wave<E, N, T> {
    let mut wave = Wave::new(layers.len());
    for (j, strain) in wave.strains.iter_mut().enumerate() {
        let of = |c: usize| {
            let n = (7 * j + 3 * c) as f64 + seed;
            Complex { re: n.sin(), im: (1.7 * n).cos() }
        };
        *strain = std::array::from_fn(of);
    }
    wave.balance(layers);
    wave
}

/// The imbalance of a wave over its largest stress.
fn imbalance<E: Effect<N, T>, const N: usize, const T: usize>(wave_number: f64) -> f64 {
    let layers = layers(wave_number);
    let wave: Wave<E, N, T> = example(&layers, 0.0);
    let scale = wave.stresses.iter().flatten().map(|s| s.size()).fold(0.0, f64::max);
    wave.imbalance(&layers) / scale.max(1.0)
}

/// Each layer is in equilibrium between the tractions on its borders, and the surface is
/// traction-free: to round-off.
#[test]
fn every_layer_is_in_equilibrium() {
    for wave_number in [0.01, 0.3, 2.0, 30.0] {
        let both = [imbalance::<InPlane, 3, 2>(wave_number), imbalance::<Antiplane, 2, 1>(wave_number)];
        assert!(both[0].max(both[1]) < 1e-13, "κ = {wave_number}: {both:?}");
    }
}

/// Work of the strain of `of` on the stress of `by`; a component counts `times` in a double
/// contraction.
fn work<E: Effect<N, T>, const N: usize, const T: usize>(
    layers: &[LayerFactors],
    [of, by]: [&Wave<E, N, T>; 2],
    times: [f64; N],
) -> Complex {
    let mut sum = Complex::ZERO;
    for ((layer, strain), stress) in layers.iter().zip(&of.strains).zip(&by.stresses) {
        for c in 0..N {
            let conjugate = strain[c].conjugate();
            let product = stress[c] * conjugate.re + stress[c].turned() * conjugate.im;
            sum = sum + product * (times[c] * layer.thickness);
        }
    }
    sum
}

/// A strain does the same work on the stress of another one as that on its own (Betti), and its
/// work on its own stress, in the unit of `sign`, is real and positive.
fn is_reciprocal<E: Effect<N, T>, const N: usize, const T: usize>(
    [one, other]: [Wave<E, N, T>; 2],
    layers: &[LayerFactors],
    times: [f64; N],
    sign: f64,
) {
    let (ab, ba) = (work(layers, [&one, &other], times), work(layers, [&other, &one], times));
    let own = work(layers, [&one, &one], times);
    let difference = ab - ba.conjugate();
    // Round-off.
    assert!(difference.size() < 1e-13 * own.size(), "{ab:?} {ba:?}");
    assert!(sign * own.re > 0.0 && own.im.abs() < 1e-13 * own.size(), "{own:?}");
}

#[test]
fn reciprocal() {
    for wave_number in [0.1, 1.0, 10.0] {
        let layers = layers(wave_number);
        let plane: [PlaneWave; 2] = [0.0, 0.5].map(|seed| example(&layers, seed));
        is_reciprocal(plane, &layers, [1.0, 1.0, 2.0], 1.0);
        let antiplane: [AntiplaneWave; 2] = [0.0, 0.5].map(|seed| example(&layers, seed));
        is_reciprocal(antiplane, &layers, [1.0, 1.0], -1.0);
    }
}
