//! Rows of resources: what is told of their sizes is what the host makes, and what is built has a recipe.

use std::collections::HashSet;
use std::sync::Arc;

use depthleap::method::METHODS;
use depthleap::part::resource::{Facts, Origin, Resource};
use depthleap::pass::build::{RECIPES, recipe};
use depthleap::plan::builds::Asset;
use depthleap::plan::{Plan, plan};
use depthleap::read;
use depthleap::resource::{self, RESOURCES, order};
use depthleap::scene::backdrop::{Backdrop, Pattern};
use depthleap::scene::environment::Picture;
use depthleap::scene::field::{Field, NanPolicy};
use depthleap::scene::settings::{
    Classification, ClipSettings, Distance, LightSettings, MeshSettings, Refraction, ShellMode, SliceCut,
};
use depthleap::scene::volume::{Volume, Voxels};
use depthleap::scene::{Scene, Settings};
use depthleap::structure::Lookup;
use depthleap::truth::preintegrated::PreintegratedTable;

fn scene(change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:12x9x7".to_owned());
    settings.image.size = [16, 12];
    settings.sampling.samples_per_pass = 2;
    change(&mut settings);
    read::scene(&settings).unwrap()
}

/// Scenes whose plans have, together, every resource that there is.
fn scenes() -> Vec<Scene> {
    let colours = vec![[0.0, 0.2, 0.4, 1.0, 0.0], [0.5, 0.2, 0.4, 1.0, 0.0], [1.0, 1.0, 0.5, 0.1, 0.9]];
    let mut holes = scene(|_| {});
    let volume = Volume::new("holes", [5, 4, 3], [1.0; 3], Voxels::F32((0..60).map(hole_at_7).collect()));
    holes.field = Field::new(volume.unwrap(), None, NanPolicy::Hole).unwrap().into();
    let table = scene(|s| s.sampling.classification = Classification::PreIntegrated);
    let coloured = scene(|s| s.transfer.points = Some(colours));
    let polygons = scene(|s| {
        let mesh = |opacity| MeshSettings { builtin: Some("box".to_owned()), opacity, ..MeshSettings::default() };
        s.meshes = vec![mesh(0.5), mesh(1.0)];
    });
    let cut = scene(|s| s.clips = vec![ClipSettings { plane: Some([0.0, 1.0, 0.0, 0.1]), ..ClipSettings::default() }]);
    let clipped = scene(|s| {
        let builtin = Some("gaussian:5x4x3".to_owned());
        s.clips = vec![ClipSettings { builtin, iso: Some(0.5), ..ClipSettings::default() }];
    });
    let surface = scene(|s| s.surface.iso = Some(90.0));
    let coloured_light = scene(|s| {
        let direction = Some([1.0, 2.0, 3.0]);
        (s.surface.iso, s.lights) =
            (Some(90.0), vec![LightSettings { direction, color: [1.0, 0.5, 0.2], ..Default::default() }]);
    });
    let reflecting = scene(|s| (s.surface.iso, s.environment.builtin) = (Some(90.0), Some("sky".to_owned())));
    let cells = scene(|s| s.method.cell = 4);
    // Stacks across each axis, and transfer functions that are searched.
    let aside = scene(|s| s.camera.eye = [2.0, 0.1, 0.2]);
    let above = scene(|s| s.camera.eye = [0.1, 2.0, 0.2]);
    let many = |red: f64| {
        scene(move |s| s.transfer.points = Some((0..20).map(|i| [f64::from(i) / 19.0, red, 0.5, 0.5, 0.4]).collect()))
    };
    let mut bent = scene(|s| s.effects.refraction = Some(Refraction { points: vec![[0.2, 1.0], [0.8, 1.5]] }));
    let picture = Picture { size: [3, 2], texels: vec![[0.25, 0.5, 1.0]; 6] };
    bent.backdrop = Some(Arc::new(Backdrop { pattern: Pattern::Picture(picture), distance: 0.5 }));
    let cut_there = scene(|s| s.method.slice_cut = SliceCut::Device);
    let shells = scene(|s| s.shells.mode = Some(ShellMode::Sum));
    let within = scene(|s| {
        (s.volume.builtin, s.camera.eye) = (Some("tets-ball:2".to_owned()), [0.1, 0.05, 0.02]);
    });
    let by_table = scene(|s| {
        s.volume.builtin = Some("tets-ball:2".to_owned());
        (s.sampling.classification, s.sampling.table) = (Classification::PreIntegrated, 4);
    });
    let on_surfaces = scene(|s| (s.volume.builtin, s.surface.iso) = (Some("tets-ball:2".to_owned()), Some(0.5)));
    vec![
        on_surfaces,
        by_table,
        within,
        shells,
        cut_there,
        aside,
        above,
        many(0.5),
        many(0.9),
        bent,
        reflecting,
        surface,
        coloured_light,
        scene(|_| {}),
        cells,
        coloured,
        holes,
        table,
        polygons,
        cut,
        clipped,
    ]
}

fn hole_at_7(i: usize) -> f32 {
    if i == 7 { f32::NAN } else { i as f32 }
}

fn plans() -> Vec<(Scene, Plan)> {
    let by = |scene: &Scene, name| {
        let mut scene = scene.clone();
        scene.settings.method.name = name;
        scene
    };
    let methods = METHODS.into_iter().filter(|method| method.on_device);
    let all = methods.flat_map(|method| scenes().into_iter().map(move |scene| (method, scene)));
    all.filter(|(method, scene)| (method.takes)(scene).is_ok())
        .map(|(method, scene)| (method.papers, by(&scene, method.name())))
        .map(|(form, scene)| {
            let plan = plan(&scene, form).unwrap();
            (scene, plan)
        })
        .collect()
}

#[test]
fn sizes_are_those_of_what_the_host_makes() {
    let mut seen = HashSet::new();
    for (scene, plan) in plans() {
        let table = scene.has_step_table().then(|| PreintegratedTable::new(&scene));
        for build in &plan.builds {
            let facts =
                Facts { table: table.as_ref(), lookup: build.asset.lookup.or(plan.distance), ..plan.facts(&scene) };
            let resource = build.asset.resource;
            if let Origin::Host(bytes) = resource.of.origin {
                assert_eq!(bytes(&facts).len() as u64, resource.bytes(&facts), "{resource:?} of {}", plan.method.name);
                seen.insert(resource);
            }
        }
    }
    let made_by_host = RESOURCES.into_iter().filter(|row| matches!(row.of.origin, Origin::Host(_)));
    assert_eq!(made_by_host.filter(|row| !seen.contains(row)).collect::<Vec<_>>(), [], "no plan asks for these");
}

#[test]
fn every_resource_of_a_plan_is_in_the_list_once_and_has_a_size() {
    let mut places = HashSet::new();
    for row in RESOURCES {
        assert!(places.insert(order(row)), "{row:?} stands twice in the list");
        assert!(!row.of.holds.is_empty(), "{row:?} says what it holds");
    }
    for (scene, plan) in plans() {
        for resource in plan.resources() {
            assert!(order(resource).0 < RESOURCES.len(), "{resource:?} is not in the list");
            assert!(resource.bytes(&plan.facts(&scene)) > 0, "{resource:?} of {}", plan.method.name);
        }
    }
}

#[test]
fn what_is_built_has_a_recipe_that_makes_it() {
    let built: Vec<Resource> = RESOURCES.into_iter().filter(|row| matches!(row.of.origin, Origin::Built)).collect();
    assert_eq!(built.len(), RECIPES.len());
    for (scene, plan) in plans() {
        for build in plan.builds.iter().filter(|build| recipe(build.asset.resource).is_some()) {
            let last = &plan.steps[build.steps.clone()].last().unwrap();
            let writes = last.accesses.iter().filter(|access| access.usage.writes());
            let assets: Vec<Asset> =
                writes.map(|access| Asset::of(access.resource, plan.distance, scene.shells.as_deref())).collect();
            assert_eq!(assets, [build.asset], "{} of {}", last.name, scene.settings.method.name.name());
        }
    }
    assert!(built.into_iter().all(|row| recipe(row).is_some()));
    assert!(recipe(resource::VOLUME).is_none());
}

#[test]
fn frames_share_what_depends_on_the_same() {
    let scene = scene(|_| {});
    let [omni, octants, along, cone] =
        [Distance::Omni, Distance::Directional, Distance::Optimal, Distance::Cone].map(|d| Lookup::new(&scene, d));
    let asset = |resource, lookup| Asset::of(resource, Some(lookup), None);
    // Whatever the distances are for, the cells are the same.
    for resource in [resource::INTERESTING, resource::WIDE_2, resource::VOLUME, resource::SUPPORT] {
        assert_eq!(asset(resource, omni), asset(resource, along), "{resource:?}");
    }
    assert_eq!(asset(resource::OMNI_DISTANCE, along), asset(resource::NEAREST_DISTANCE, omni));
    let distances = [omni, octants, along, cone].map(|lookup| asset(resource::NEAREST_DISTANCE, lookup));
    assert!((0..4).all(|i| (0..i).all(|j| distances[i] != distances[j])));
    let larger = Lookup { cell: 4, ..omni };
    assert_ne!(asset(resource::INTERESTING, omni), asset(resource::INTERESTING, larger));
    assert_ne!(resource::CELL_RANGE.at(4), resource::block_ranges());
}
