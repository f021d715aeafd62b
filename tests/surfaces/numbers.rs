//! Places and normals of surfaces, shown as numbers.

use depthleap::method::RC_ERT;
use depthleap::plan::{Plan, plan};
use depthleap::scene::settings::{LightSettings, Refine, Shows};
use depthleap::truth::exact::ExactIntegrator;
use glam::DVec3;

use super::drawn::drawn;
use super::{SIZE, scene};

/// What the twin's frame shows of a surface that is found exactly, and what the exact rays show, of pixels in which both meet it.
fn shown(shows: Shows) -> Vec<(DVec3, DVec3, DVec3)> {
    let scene = scene("gaussian:24", 0.4, |s| (s.surface.refine, s.surface.shows) = (Refine::Exact, shows));
    let (plan, frame) = drawn(&scene);
    let exact = ExactIntegrator::of(&scene).picture(&plan.view.rays, SIZE);
    let numbers = |[x, y, z, _]: [f64; 4]| DVec3::new(x, y, z);
    let mut all = Vec::new();
    for (i, (found, truth)) in frame.pixels.iter().zip(exact).enumerate() {
        assert!([0.0, 1.0].contains(&found[3]), "{found:?}");
        let direction = plan.view.rays.of(i as u32 % SIZE[0], i as u32 / SIZE[0]).direction.normalize();
        if found[3] > 0.0 && truth[3] > 0.0 {
            all.push((numbers(*found), numbers(truth), direction));
        }
    }
    assert!(all.len() > 300, "{} rays meet the surface", all.len());
    all
}

#[test]
fn places_show_where_the_exact_rays_meet_the_surface() {
    let mut errors: Vec<f64> = shown(Shows::Position).iter().map(|(found, truth, _)| found.distance(*truth)).collect();
    errors.sort_by(f64::total_cmp);
    // Rays that only touch the surface are off by more: by what the slack of its values is to them.
    let (most, all) = (errors[errors.len() * 49 / 50], errors[errors.len() - 1]);
    println!("{most:e} {all:e}");
    assert!(most < 5e-6 && all < 1e-3, "{most:e} {all:e}");
}

#[test]
fn normals_show_with_the_length_1_turned_to_the_eye() {
    for (found, truth, direction) in shown(Shows::Normal) {
        for normal in [found, truth] {
            assert!((normal.length() - 1.0).abs() < 1e-12 && normal.dot(direction) <= 1e-12, "{normal} {direction}");
        }
        assert!(found.cross(truth).length() < 0.3, "{found} {truth}");
    }
    // A plateau has none.
    let flat = scene("constant:8", 0.5, |s| s.surface.shows = Shows::Normal);
    let met: Vec<[f64; 4]> = drawn(&flat).1.pixels.into_iter().filter(|pixel| pixel[3] > 0.0).collect();
    assert!(met.len() > 300 && met.iter().all(|pixel| *pixel == [0.0, 0.0, 0.0, 1.0]));
}

#[test]
fn no_light_takes_part_in_places_and_normals() {
    let light = LightSettings { direction: Some([1.0, 2.0, 3.0]), color: [1.0, 0.5, 0.2], ..Default::default() };
    let of = |shows: Shows| {
        let scene = scene("shells:12", 90.0, |s| (s.surface.shows, s.lights) = (shows, vec![light.clone()]));
        plan(&scene, RC_ERT.papers).unwrap()
    };
    let reads_lights = |plan: &Plan| plan.resources().iter().any(|resource| resource.name().contains("lights"));
    assert!(reads_lights(&of(Shows::Color)));
    for shows in [Shows::Position, Shows::Normal] {
        let plan = of(shows);
        assert!(!reads_lights(&plan), "{shows:?}");
        assert!(plan.left_out.iter().any(|left| left.why.contains("which no light changes")), "{:?}", plan.left_out);
    }
}
