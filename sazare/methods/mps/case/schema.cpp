#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/cases/format/usual_values.hpp"
#include "sazare/cases/law_keys.hpp"
#include "sazare/cases/soil/keys.hpp"
#include "sazare/methods/mps/case/format.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 2> fits{"exact", "inside"};
constexpr std::array<std::string_view, 2> removals{"mean_rotation", "mean_angle"};
constexpr std::array<std::string_view, 3> shapes{"rectangle", "polygon", "mesh"};
constexpr std::array<std::string_view, 7> sides{"left", "right", "bottom", "top", "front", "back", "all"};
constexpr std::array<std::string_view, 2> extents{"plane", "surface"};
constexpr std::array<std::string_view, 5> side_kinds{"fixed", "roller", "prescribed", "viscous", "free_field"};
constexpr std::array<std::string_view, 2> rotation_torques{"half", "whole"};
constexpr std::array<std::string_view, 2> euler_dampings{"present", "lagged"};
constexpr std::array<std::string_view, 3> integrators{"verlet", "leapfrog", "euler"};

constexpr std::string_view two_of_three = "exactly two of s_wave_velocity, p_wave_velocity and poisson_ratio";
constexpr std::string_view with_strength = "required with a cohesion";
constexpr std::string_view with_motion = "kinds prescribed and viscous only";

constexpr std::array particle_keys{
    Key{.name = "spacing",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .need = Need::required,
        .sentence = "Distance between neighbouring particles on the lattice: twice the radius of a particle."},
    Key{.name = "dimension",
        .type = Type::integer,
        .range = {.low = 2, .high = 3},
        .default_text = "2",
        .sentence = "2 for plane strain in x and y (up), 3 for a body in x, y and z (up)."},
    Key{.name = "influence",
        .type = Type::number,
        .range = {.low = 1, .high = 3, .low_open = true},
        .default_text = "1.5",
        .sentence = "Influence radius divided by the spacing: particles nearer than this are linked."},
    Key{.name = "fit",
        .type = Type::choice,
        .default_text = "\"exact\"",
        .sentence = "Whether rectangles must be whole multiples of the spacing, or hold as many particles as fit inside.",
        .choices = fits},
    Key{.name = "periodic",
        .type = Type::axes,
        .default_text = "[]",
        .sentence = "Axes along which the body is periodic: its two ends are linked, as in an infinite layer."},
    Key{.name = "rotation",
        .type = Type::choice,
        .default_text = "\"mean_rotation\"",
        .sentence = "How rigid rotation is removed from the deformation of a link: by the mean of the two rotations, or by the "
                    "mean angle (2-D only).",
        .choices = removals},
    Key{.name = "rotation_torque",
        .type = Type::choice,
        .default_text = "\"half\"",
        .sentence =
            "Torque of a link on each of its particles: half of its arm times its force, which keeps the angular momentum, or "
            "the whole, for comparisons: as with half the moment of inertia, elastic ground only.",
        .choices = rotation_torques},
};

constexpr std::array region_keys{
    Key{.name = "name",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Name by which materials refer to the region; where regions overlap, the last one applies."},
    Key{.name = "shape",
        .type = Type::choice,
        .default_text = "\"rectangle\"",
        .sentence = "A rectangle (in 3-D a box), a polygon (2-D), or a volume group of a Gmsh mesh.",
        .choices = shapes},
    Key{.name = "lower",
        .type = Type::vector,
        .unit = "m",
        .note = "required for a rectangle",
        .sentence = "Corner with the smallest coordinates; z is 0 in 2-D."},
    Key{.name = "upper",
        .type = Type::vector,
        .unit = "m",
        .note = "required for a rectangle",
        .sentence = "Corner with the largest coordinates; z is 0 in 2-D."},
    Key{.name = "points",
        .type = Type::points,
        .unit = "m",
        .note = "required for a polygon",
        .sentence = "Corners in order, first and last the same."},
    Key{.name = "file",
        .type = Type::file,
        .note = "required for a mesh",
        .sentence = "Gmsh mesh (.msh, format 4.1) or geometry (.geo); in 2-D its section z = 0."},
    Key{.name = "group",
        .type = Type::text,
        .note = "required for a mesh",
        .sentence = "Physical volume group of the mesh that is filled."},
};

constexpr std::array own_material_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the material in messages."},
    Key{.name = "regions", .type = Type::names, .need = Need::required, .sentence = "Regions that consist of the material."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .usual = usual::density,
        .need = Need::required,
        .sentence = "Mass per volume."},
    Key{.name = "s_wave_velocity",
        .type = Type::number,
        .unit = "m/s",
        .range = positive,
        .usual = usual::wave_velocity,
        .note = two_of_three,
        .sentence = "Velocity of S waves."},
    Key{.name = "p_wave_velocity",
        .type = Type::number,
        .unit = "m/s",
        .range = positive,
        .usual = usual::wave_velocity,
        .note = two_of_three,
        .sentence = "Velocity of P waves."},
    Key{.name = "poisson_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 0.5, .high_open = true},
        .note = two_of_three,
        .sentence = "Poisson's ratio."},
    Key{.name = "damping_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 2},
        .usual = usual::damping_ratio,
        .default_text = "0.0",
        .sentence = "Damping ratio at the frequencies f1 and f2 of [damping]."},
    Key{.name = "cohesion",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .usual = usual::strength,
        .note = "default: the material is elastic and never fails",
        .sentence = "Cohesion of the Mohr-Coulomb strength."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 60},
        .usual = usual::friction_angle,
        .note = with_strength,
        .sentence = "Friction angle, of broken ground too."},
    Key{.name = "dilation_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 60},
        .default_text = "0.0",
        .note = "only with a cohesion",
        .sentence = "Dilation angle; at most the friction angle."},
    Key{.name = "tensile_strength",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .usual = usual::strength,
        .note = "only with a cohesion; default: cohesion/tan(friction_angle), without friction none",
        .sentence = "Tension cut-off: largest tensile stress; at most cohesion/tan(friction_angle)."},
    Key{.name = "rupture_strain",
        .type = Type::number,
        .range = positive,
        .default_text = "0.1",
        .note = "only with a cohesion",
        .sentence = "Equivalent plastic shear strain (engineering) or tensile opening at which the ground breaks: it then has "
                    "friction, but no "
                    "cohesion and no links."},
    Key{.name = "residual_cohesion",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .usual = usual::strength,
        .note = "only with a cohesion, and with a softening_displacement; default: the cohesion stays",
        .sentence = "Cohesion to which that of ground that yields falls; the tensile strength falls with it."},
    Key{.name = "residual_friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 60},
        .note = "only with a cohesion, and with a softening_displacement; default: friction and dilation stay",
        .sentence =
            "Angle of friction to which that of ground that yields falls; its dilation ends with it. Ground that has broken "
            "has this friction."},
    Key{.name = "softening_displacement",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .note = "required with a residual_cohesion or a residual_friction_angle",
        .sentence =
            "Slip across a shear band over which the strength would fall to the residual one at the rate at which it begins to; "
            "it does not depend on the spacing."},
};

constexpr auto material_keys = joined(own_material_keys, soil_keys);

constexpr std::array boundary_keys{
    Key{.name = "side",
        .type = Type::choice,
        .need = Need::required,
        .sentence = "Side of the body, or of a region: left and right are along x, front and back along y in 3-D, bottom and top "
                    "vertical; all: every particle.",
        .choices = sides},
    Key{.name = "extent",
        .type = Type::choice,
        .default_text = "\"plane\"",
        .sentence =
            "plane: the outermost plane of particles; surface: all particles without a neighbour in this direction, on slope "
            "faces, overhangs and in cavities too.",
        .choices = extents},
    Key{.name = "region", .type = Type::text, .note = "default: the whole body", .sentence = "Region whose side is meant."},
    Key{.name = "kind",
        .type = Type::choice,
        .need = Need::required,
        .sentence = "fixed: held along all axes; roller: held normal to the side; prescribed: moves with the within motion (E + "
                    "F); viscous: lets waves leave and an incident wave (E) enter; free_field: left, right, front and back only, "
                    "a side that "
                    "moves as a column of its own layers on the same base does, and lets waves leave.",
        .choices = side_kinds},
    Key{.name = "axes",
        .type = Type::axes,
        .default_text = "[]",
        .note = "kind roller only; none: normal to the side",
        .sentence = "Axes along which a roller is held."},
    Key{.name = "motion_x", .type = Type::text, .note = with_motion, .sentence = "Motion along x."},
    Key{.name = "motion_y", .type = Type::text, .note = with_motion, .sentence = "Motion along y."},
    Key{.name = "motion_z", .type = Type::text, .note = with_motion, .sentence = "Motion along z."},
};

constexpr std::array contact_keys{
    Key{.name = "damping_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 2},
        .default_text = "0.2",
        .sentence =
            "Damping ratio of broken ground, for the motion of its particles that is no smooth deformation, and of contacts."},
};

constexpr std::array ground_gravity_keys{
    gravity_keys.front(),
    Key{.name = "settle",
        .type = Type::boolean,
        .default_text = "false",
        .sentence =
            "Begin in equilibrium under gravity: it is found first, viscous boundaries and free-field sides keep carrying "
            "their reactions in it, and displacements count from it."},
    Key{.name = "max_settling_steps",
        .type = Type::integer,
        .range = {.low = 1, .high = 1000000000},
        .default_text = "200000",
        .sentence = "Maximum steps to reach equilibrium under gravity, with 1e-5 of gravity left as acceleration; after these "
                    "the ground is "
                    "reported as unstable where more than 1e-4 is left."},
};

constexpr std::array noise_keys{
    Key{.name = "velocity",
        .type = Type::number,
        .unit = "m/s",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Largest random initial velocity of every degree of freedom (rotations: divided by half a spacing)."},
    Key{.name = "seed",
        .type = Type::integer,
        .range = {.low = 1, .high = 1000000},
        .default_text = "1",
        .sentence = "Seed of the random numbers."},
};

constexpr std::array gauge_keys{
    gauge_name_key,
    Key{.name = "point",
        .type = Type::vector,
        .unit = "m",
        .need = Need::required,
        .sentence = "Initial position: the gauge records the motion of the nearest particle, at most one spacing away."},
};

constexpr std::array time_keys{
    end_key,
    Key{.name = "step",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .note = "default: stability_fraction of the predicted stability limit, or a little less",
        .sentence = "Time step of all particles; above the predicted stability limit the case is refused."},
    Key{.name = "stability_fraction",
        .type = Type::number,
        .range = stability_fraction_range,
        .default_text = "0.9",
        .sentence = "Ratio of the step to the predicted stability limit where no step is given."},
    Key{.name = "integrator",
        .type = Type::choice,
        .default_text = "\"verlet\"",
        .sentence = "Time integration scheme.",
        .choices = integrators},
    Key{.name = "euler_damping",
        .type = Type::choice,
        .default_text = "\"present\"",
        .note = "integrator euler only",
        .sentence = "Rate of the elastic forces by which Rayleigh damping acts in Euler's step: the present one, or lagged by a "
                    "step, for "
                    "comparisons.",
        .choices = euler_dampings},
    history_interval_key,
    snapshot_interval_key,
    strict_key,
};

constexpr std::array tables{
    case_table,
    Table{"particles", false, Need::required, "Lattice of the particles.", particle_keys},
    Table{"regions", true, Need::required, "Regions that are filled with particles.", region_keys},
    Table{"materials", true, Need::required, "Materials of the regions.", material_keys},
    Table{"damping", false, Need::optional, "Rayleigh damping: its two frequencies.", damping_keys},
    motions_table,
    Table{"boundaries", true, Need::optional, "Boundary conditions of the sides; all others are free.", boundary_keys},
    Table{"contact", false, Need::optional, "Broken ground, and contact between bodies.", contact_keys},
    Table{"gravity", false, Need::optional, "Body force.", ground_gravity_keys},
    Table{"noise", false, Need::optional, "Small random initial motion, so that every instability can grow.", noise_keys},
    Table{"gauges", true, Need::optional, "Points whose motion is recorded.", gauge_keys},
    Table{"time", false, Need::required, "Duration, time step and intervals of output.", time_keys},
    output_table,
};

}  // namespace

std::span<const Table> mps_schema() { return tables; }

}  // namespace sazare::cases
