//! Whether a scene fits, asked before anything large is made for it.

use crate::error::{Error, Result};
use crate::part::resource::{Resource, ResourceKind};
use crate::plan::Plan;
use crate::plan::builds::Maker;
use crate::resource;
use crate::scene::{Scene, Volume};
use crate::truth::importance;
use crate::vulkan::DeviceInfo;

/// Bytes a pixel takes on the host at the most: the frame in f64 twice, the picture in f32, the encoded file.
const HOST_BYTES: u64 = 128;

/// Whether the device takes pictures and volumes of this size.
///
/// # Errors
/// When a limit of the device, which is named, is exceeded.
pub fn check_device(info: &DeviceInfo, scene: &Scene, plan: &Plan) -> Result<()> {
    let picture =
        |problem| Err(Error::device(picture_name(scene), problem, "choose a smaller picture or another device"));
    let [width, height] = info.max_viewport.map(|side| side.min(info.max_image_2d));
    let size = scene.settings.image.size;
    if size[0] > width || size[1] > height {
        return picture(format!("{} allows at most {width}x{height} pixels", info.name));
    }
    let resources = plan.resources();
    let facts = plan.facts(scene);
    let of_pixels =
        resources.iter().filter(|r| matches!(r.of.kind, ResourceKind::Target(_) | ResourceKind::Staging(_)));
    let (needed, there) = (of_pixels.map(|r| r.bytes(&facts)).sum::<u64>(), info.memory_bytes);
    if needed > there {
        return picture(format!("takes {} MiB of device memory, {} has {}", needed >> 20, info.name, there >> 20));
    }
    let volume = &scene.field.volume;
    let read = |of: Resource| resources.iter().any(|one| std::ptr::eq(one.of, of.of));
    if read(resource::GRADIENTS) && resource::gradient_bytes(scene) > there {
        let needed = resource::gradient_bytes(scene);
        return Err(Error::device(
            &volume.name,
            format!("has gradients that take {} MiB of device memory, {} has {}", needed >> 20, info.name, there >> 20),
            "use --gradient-texture rgba8, or --gradients on-the-fly",
        ));
    }
    check_shells(info, scene, plan)?;
    let limit = info.max_image_3d;
    let fits = |volume: &Volume, remedy: &str| {
        let problem = || format!("has {:?} voxels, {} allows at most {limit} a side", volume.dims, info.name);
        match volume.dims.iter().any(|&n| n > limit as usize) {
            true => Err(Error::device(&volume.name, problem(), remedy)),
            false => Ok(()),
        }
    };
    if read(resource::VOLUME) || read(resource::GRADIENTS) {
        fits(volume, "use a smaller volume, another device, or --method cpu")?;
    }
    let Some(clip) = scene.clip_volume.as_ref().filter(|_| read(resource::CLIP_VOLUME)) else { return Ok(()) };
    fits(&clip.field.volume, "use a smaller clip volume, or another device")?;
    let needed = resource::CLIP_VOLUME.bytes(&facts);
    if needed > there {
        let problem = format!("takes {} MiB of device memory, {} has {}", needed >> 20, info.name, there >> 20);
        return Err(Error::device(&clip.field.volume.name, problem, "use a smaller clip volume"));
    }
    Ok(())
}

/// Whether the shells of a plan fit, all of which are there at once.
fn check_shells(info: &DeviceInfo, scene: &Scene, plan: &Plan) -> Result<()> {
    if plan.method.takes_samples() {
        return Ok(());
    }
    let (needed, there) = (resource::shell_bytes(scene).into_iter().sum::<u64>(), info.memory_bytes);
    let drawn = scene.shells.iter().flat_map(|shells| shells.drawn());
    let vertices = drawn.map(|shell| shell.count(&scene.field)[0]);
    let most = vertices.max().unwrap_or(0);
    let problem = match () {
        () if needed > there => {
            format!("has shells that take {} MiB of device memory, {} has {}", needed >> 20, info.name, there >> 20)
        }
        () if most.saturating_sub(1) > info.max_vertex_number => {
            format!("has a shell of {most} vertices, {} numbers at most {}", info.name, info.max_vertex_number)
        }
        () => return Ok(()),
    };
    Err(Error::device(&scene.field.volume.name, problem, "use fewer shells, or levels of smaller ones"))
}

/// Whether there is memory for the pictures, and for what the host builds.
///
/// # Errors
/// When there is not.
pub fn check_host(scene: &Scene, plan: &Plan) -> Result<()> {
    let there = |needed: u64| usize::try_from(needed).is_ok_and(|n| Vec::<u8>::new().try_reserve_exact(n).is_ok());
    if scene.has_gradient_texture() && !there(resource::gradient_bytes(scene)) {
        let problem = format!(
            "has gradients that take {} MiB of memory, which are not available",
            resource::gradient_bytes(scene) >> 20
        );
        return Err(Error::input(&scene.field.volume.name, problem, "use --gradients on-the-fly"));
    }
    let on_host = plan.builds.iter().filter(|build| build.maker == Maker::Host && build.asset.level.is_some());
    let shells = on_host.map(|build| build.asset.resource.bytes(&plan.facts(scene))).sum();
    if !there(shells) {
        let problem = format!("has shells that take {} MiB of memory, which are not available", shells >> 20);
        return Err(Error::input(&scene.field.volume.name, problem, "use fewer shells, or levels of smaller ones"));
    }
    if scene.settings.adaptive.importance {
        let needed = importance::host_bytes(scene);
        if !there(needed) {
            let problem =
                format!("needs {} MiB of memory to find lengths of steps, which are not available", needed >> 20);
            return Err(Error::input(&scene.field.volume.name, problem, "leave --importance out"));
        }
    }
    let needed = HOST_BYTES * pixels(scene);
    if there(needed) {
        return Ok(());
    }
    let problem = format!("takes {} MiB of memory, which are not available", needed >> 20);
    Err(Error::usage(picture_name(scene), problem, "choose a smaller picture"))
}

fn pixels(scene: &Scene) -> u64 {
    scene.settings.image.size.map(u64::from).iter().product()
}

fn picture_name(scene: &Scene) -> String {
    let [width, height] = scene.settings.image.size;
    format!("image.size (--viewport) {width}x{height}")
}
