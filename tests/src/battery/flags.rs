//! The flags that each assignment adds, as its program's help must list them.

/// Assignment by assignment, from 1 on.
const OWN: [&[&str]; 8] = [
    &["-input", "-output", "-size", "-depth", "-threads", "-stats"],
    &["-normals", "-shade_back"],
    &["-gui", "-tessellation", "-gouraud"],
    &["-shadows", "-bounces", "-weight", "-transparent_shadows"],
    &["-grid", "-visualize_grid", "-visualize_grid_count"],
    &["-accel", "-kdtree", "-kd_max_depth", "-kd_leaf", "-visualize_kdtree", "-heat"],
    &[
        "-random_samples",
        "-uniform_samples",
        "-jittered_samples",
        "-render_samples",
        "-box_filter",
        "-tent_filter",
        "-gaussian_filter",
        "-render_filter",
        "-sampler",
        "-samples",
        "-seed",
        "-filter",
        "-adaptive",
        "-samples_image",
        "-aperture",
        "-focal_distance",
        "-blades",
        "-light_samples",
        "-hard_lights",
        "-smooth",
        "-smooth_edges",
        "-zoom",
        "-orbit",
        "-rotate",
        "-twist",
        "-shift",
        "-move_screen",
    ],
    &[
        "-spp",
        "-time",
        "-error",
        "-integrator",
        "-rr_depth",
        "-crop",
        "-spp_range",
        "-checkpoint",
        "-resume",
        "-aov",
        "-linear",
    ],
];

/// The flags of an assignment's program: its own, and those of all steps below.
///
/// # Panics
/// If there is no list for it.
pub fn up_to(assignment: u8) -> Vec<&'static str> {
    OWN[..usize::from(assignment)].concat()
}
