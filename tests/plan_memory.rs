//! Memory of planning: it grows with the passes by little, so that a small scene file cannot ask for much.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use depthleap::method;
use depthleap::part::rows::Method;
use depthleap::plan;
use depthleap::read;
use depthleap::scene::settings::{MethodName, Settings};

/// The system's allocator with the bytes that are allocated and the most there were.
struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call goes to the system's allocator as it is; only numbers are kept beside it.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        MOST.fetch_max(HELD.fetch_add(layout.size(), Relaxed) + layout.size(), Relaxed);
        // SAFETY: the caller keeps what `alloc` asks for.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the pointer came from `alloc` above with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The most bytes that planning took at once, and the steps planned.
fn cost(method: MethodName, passes: u32) -> (usize, usize) {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:8".into());
    settings.image.size = [8, 8];
    settings.method.name = method;
    settings.sampling.passes = passes;
    let scene = read::scene(&settings).unwrap();
    let form = plan::form(&scene, method::papers_form(method)).unwrap();
    let before = HELD.load(Relaxed);
    MOST.store(before, Relaxed);
    let plan = plan::plan(&scene, form).unwrap();
    (MOST.load(Relaxed) - before, plan.steps.len())
}

/// What a step may take: itself, its name, and its share of what holds it.
const BYTES_A_STEP: usize = 256;

/// One test alone: the counter is the whole process'.
#[test]
fn planning_takes_little_for_each_pass() {
    counting_sees_what_is_allocated();
    for method in method::METHODS.into_iter().filter(|method| method.takes_samples()).map(Method::name) {
        let (few, _) = cost(method, 64);
        let (many, steps) = cost(method, 16_384);
        let a_step = (many - few) / steps;
        assert!(a_step <= BYTES_A_STEP, "{}: {a_step} bytes a step", method.name());
    }
}

/// Whether the numbers above see an allocation at all.
fn counting_sees_what_is_allocated() {
    let before = HELD.load(Relaxed);
    MOST.store(before, Relaxed);
    drop(std::hint::black_box(vec![0u8; 1 << 20]));
    assert!(MOST.load(Relaxed) - before >= 1 << 20);
}
