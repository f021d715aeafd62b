//! The exact integrator at the ends of what numbers there are: every ray is finite, its opacity from 0 to 1.

mod random;

use depthleap::scene::field::NanPolicy;
use depthleap::scene::transfer::Knot;
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, TransferFunction, Volume};
use depthleap::truth::exact::ExactIntegrator;
use glam::DVec3;
use random::Random;

const VOLUMES: usize = 20_000;

fn pick<T: Copy>(random: &mut Random, from: &[T]) -> T {
    from[(random.next() * from.len() as f64) as usize]
}

#[test]
fn every_ray_is_finite() {
    const VALUES: [f32; 12] = [
        f32::MAX,
        f32::MIN,
        f32::MIN_POSITIVE,
        -f32::MIN_POSITIVE,
        1e-45,
        0.0,
        -0.0,
        0.5,
        1.0,
        1e30,
        -1e30,
        1.000_000_1,
    ];
    const PLACES: [f64; 9] = [-1e30, -1.0, 0.0, 1e-300, 0.5, 0.500_000_000_000_1, 1.0, 1e30, 1e30];
    let mut random = Random(21);
    for i in 0..VOLUMES {
        let dims = [0; 3].map(|_| 1 + (random.next() * 4.0) as usize);
        let spacing = [0; 3].map(|_| 10f64.powf(random.next() * 60.0 - 30.0));
        let spacing = if random.next() < 0.5 { [1.0; 3] } else { spacing };
        let few: Vec<f32> = (0..3).map(|_| pick(&mut random, &VALUES)).collect();
        let voxels = (0..dims.iter().product()).map(|_| pick(&mut random, &few)).collect();
        let volume = Volume::new("extreme", dims, spacing, Voxels::F32(voxels)).unwrap();
        let field = Field::new(volume, Some([0.0, 1.0]), NanPolicy::Replace).unwrap();
        let mut x: Vec<f64> = (0..1 + (random.next() * 5.0) as usize).map(|_| pick(&mut random, &PLACES)).collect();
        x.sort_by(f64::total_cmp);
        let mut knot = |x: f64| {
            let color = [0; 3].map(|_| pick(&mut random, &[0.0, 0.3, 1.0, 1e30, 1e-300]));
            Knot { x, color, opacity: pick(&mut random, &[0.0, 1e-300, 0.3, 0.999_999_999_999_9, 1.0]) }
        };
        let knots: Vec<Knot> = x.into_iter().map(&mut knot).collect();
        let reference = pick(&mut random, &[1e-6, 1.0, 1e6]);
        let transfer = TransferFunction::new("extreme", knots, reference).unwrap();
        let brightest = transfer.knots().iter().flat_map(|k| k.color).fold(1.0, f64::max);
        let place = |random: &mut Random| DVec3::from_array([0; 3].map(|_| random.next() - 0.5)) * field.extent();
        let (from, to) = (place(&mut random), place(&mut random));
        let rgba = ExactIntegrator::new(&field, &transfer).ray(from, (to - from).normalize(), (to - from).length());
        let sound = rgba[..3].iter().all(|c| c.is_finite() && *c > -1e-6 * brightest && *c < brightest * 1.000_001);
        assert!(
            sound && (0.0..=1.0).contains(&rgba[3]),
            "volume {i}: {rgba:?} from {:?} of {dims:?} by {spacing:?}, {:?}, reference {reference}",
            field.values,
            transfer.knots()
        );
    }
}
