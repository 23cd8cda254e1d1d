//! The list of all checks.

use crate::Stress;

/// A check of one of the promises.
#[derive(Clone, Copy)]
pub struct Property {
    /// Its number in `accuracy.md`, 1 … 18.
    pub number: u8,
    /// Unlike any other's; begins with `p` and the number.
    pub name: &'static str,
    /// What is promised, in a line.
    pub promise: &'static str,
    /// Does as much as it is asked to, and leaves what it finds with the [`Stress`].
    pub check: fn(&Stress),
}

/// Hands the list of all checks to another macro: number, name, promise and function of each.
/// `tests/quick` makes a test of each, so that names, and failures, are seen one by one.
#[macro_export]
macro_rules! all_properties {
    ($use:ident) => {
        $use! {
            1 p01_grid "rays from inside a closed mesh hit it, through the grid" => watertight::grids;
            1 p01_trees "the same through the kd-tree and the hierarchy" => watertight::trees;
            1 p01_list "the same by asking every triangle" => watertight::lists;
            1 p01_parity "whole lines pass a closed mesh an odd number of times each way" => watertight::parity;
            2 p02_places "no leak at any size and place, through any structure" => watertight::places;
            2 p02_nested "no leak under transforms around transforms" => watertight::nested;
            2 p02_instructions "every instruction set finds the scalar hit" => watertight::instructions;
            3 p03_decisions "triangles are hit when exact arithmetic says so" => values::decisions;
            3 p03_values "t, u, v within 16 eps S / cos" => values::values;
            3 p03_any_bits "triangles and rays of any bits give no NaN" => values::any_bits;
            3 p03_filter "what stands in front of the exact test is never wrong" => values::filter;
            4 p04_spheres "t of spheres within 4 eps at any size and distance" => round::spheres;
            4 p04_special "grazing, inside, on the surface: ordered roots" => round::special_spheres;
            4 p04_planes "no threshold for parallel" => round::planes;
            5 p05_depths "t, p, n within 32 eps cond, at any depth" => transforms::depths;
            5 p05_singular "small is not singular, a lost dimension is" => transforms::singular;
            6 p06_lossless "powers of two, turned and mirrored axes change no bit" => values::lossless;
            7 p07_spheres "leaving a sphere outward never hits it again" => secondary::spheres;
            7 p07_ellipsoids "the same for ellipsoids" => secondary::ellipsoids;
            7 p07_triangles "the same for triangles" => secondary::triangles;
            7 p07_planes "the same for planes" => secondary::planes;
            7 p07_meshes "the same for convex meshes" => secondary::meshes;
            7 p07_close_planes "planes 64 eps S apart leak nothing" => secondary::close_planes;
            8 p08_bounces "1000 bounces in a sphere stay inside" => secondary::bounces;
            8 p08_black_box "a closed box without a light is black" => secondary::black_box;
            8 p08_black_path "the same by path tracing" => light::black_box;
            9 p09_special "zeros, subnormal and huge numbers: as brute force" => structures::special;
            9 p09_flat_boxes "flat boxes are hit" => structures::flat_boxes;
            9 p09_not_finite "NaN and infinity hit nothing, and end" => structures::not_finite;
            10 p10_scenes "all structures agree to the bit on every scene" => structures::scenes;
            10 p10_meshes "the same on every mesh" => structures::meshes;
            10 p10_far_away "the same far from the origin" => structures::far_away;
            11 p11_random "the march visits the cells of exact arithmetic" => march::random;
            11 p11_special "the same along edges, corners and faces" => march::special;
            11 p11_triangles "no cell of a triangle is missing" => march::triangles;
            11 p11_spheres "no cell of a sphere is missing" => march::spheres;
            12 p12_odd "structures are valid for odd worlds" => builds::odd;
            12 p12_ties "ties go to the lowest number" => builds::ties;
            12 p12_nested "100,000 nested groups and transforms" => builds::nested;
            12 p12_crowds "structures over many boxes are valid" => builds::crowds;
            12 p12_threads "builds do not depend on the number of threads" => builds::threads;
            13 p13_surfaces "samples of surfaces follow their densities" => light::samples;
            13 p13_weights "weights are values over densities" => light::weights;
            13 p13_reciprocity "directions can be exchanged" => light::reciprocity;
            13 p13_glass "glass lets as much in as out" => light::glass;
            13 p13_highlights "highlights send back no more than arrives" => light::highlights;
            13 p13_furnace "white things in a white world cannot be seen" => light::furnace;
            13 p13_white_sky "nor under a white sky that is asked for" => light::white_sky;
            13 p13_glossy "glossy things are not brighter than their world" => light::glossy;
            13 p13_absorption "glass dims light as Beer and Lambert say" => light::absorption;
            13 p13_shells "a closed shell has the radiance of the series" => light::shells;
            13 p13_lights "what lights offer follows its density" => light::offers;
            13 p13_offers "paths are weighed by the density of the offer" => light::weighed;
            13 p13_light_trees "trees choose lights as often as they say" => light::trees;
            13 p13_sky "what the sky offers follows its density" => light::sky_offers;
            14 p14_integrators "integrators and roulette do not change the light" => light::integrators;
            14 p14_samplers "samplers do not change the light" => light::samplers;
            14 p14_bounces "bounces add up to the limit" => light::bounces;
            14 p14_cut_short "paths that are cut short lack the rest" => light::cut_short;
            14 p14_direct_light "a square's direct light is its form factor" => light::direct_light;
            14 p14_slopes "errors fall with the root of the samples" => light::slopes;
            15 p15_analytic "what a filter covers has the analytic value" => pixels::analytic;
            15 p15_uniform "the same for the uniform pattern" => pixels::uniform;
            15 p15_weights "weights sum to one" => pixels::weights;
            15 p15_board "errors on a board to the horizon fall as its edges let them" => pixels::board;
            15 p15_slopes "errors fall as fast as patterns promise" => pixels::slopes;
            16 p16_whitted "threads, tiles and structures change no bit" => determinism::whitted;
            16 p16_path "the same by path tracing, resumed or in part" => determinism::path;
            16 p16_processes "nor does the way the program was built" => determinism::processes;
            17 p17_whole "what is whole stays whole" => simplify::whole;
            17 p17_named "what is no surface is held and reported" => simplify::named;
            17 p17_soups "any triangles at all come to an end" => simplify::soups;
            18 p18_scenes "damaged scenes are read or refused, in time and memory" => input::scenes;
            18 p18_ifs "so are iterated function systems" => input::ifs;
            18 p18_meshes "so are meshes" => input::meshes;
            18 p18_pictures "so are pictures" => input::pictures;
            18 p18_checkpoints "so are checkpoints" => input::checkpoints;
            18 p18_command_lines "so are command lines" => input::command_lines;
        }
    };
}

macro_rules! table {
    ($($number:literal $name:ident $promise:literal => $($check:ident)::+;)*) => {
        &[$(Property {
            number: $number,
            name: stringify!($name),
            promise: $promise,
            check: crate::$($check)::+,
        }),*]
    };
}

/// Every check, in the order of the promises.
pub fn properties() -> &'static [Property] {
    all_properties!(table)
}
