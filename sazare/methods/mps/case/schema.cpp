#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/methods/mps/case/format.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 2> fits{"exact", "inside"};
constexpr std::array<std::string_view, 2> removals{"mean_rotation", "mean_angle"};
constexpr std::array<std::string_view, 3> shapes{"rectangle", "polygon", "mesh"};
constexpr std::array<std::string_view, 7> sides{"left", "right", "bottom", "top", "front", "back", "all"};
constexpr std::array<std::string_view, 4> side_kinds{"fixed", "roller", "prescribed", "viscous"};
constexpr std::array<std::string_view, 3> integrators{"verlet", "leapfrog", "euler"};

constexpr std::string_view two_of_three = "exactly two of shear_velocity, pressure_velocity and poisson_ratio";
constexpr std::string_view with_strength = "required with a cohesion";
constexpr std::string_view with_motion = "kinds prescribed and viscous only";

constexpr std::array particle_keys{
    Key{.name = "spacing",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .need = Need::required,
        .sentence = "Distance of neighbouring particles on the lattice, twice the particle's radius."},
    Key{.name = "dimension",
        .type = Type::integer,
        .range = {.low = 2, .high = 3},
        .default_text = "2",
        .sentence = "2 for plane strain in x and y (up), 3 for a body in x, y and z (up)."},
    Key{.name = "influence",
        .type = Type::number,
        .range = {.low = 1, .high = 3, .low_open = true},
        .default_text = "1.5",
        .sentence = "Influence radius over the spacing: particles nearer than this are linked."},
    Key{.name = "fit",
        .type = Type::choice,
        .default_text = "\"exact\"",
        .sentence = "Whether rectangles must be whole multiples of the spacing, or hold as many particles as fit inside.",
        .choices = fits},
    Key{.name = "periodic",
        .type = Type::axes,
        .default_text = "[]",
        .sentence = "Axes along which the body repeats itself: its two ends are linked, as in a layer without end."},
    Key{.name = "rotation",
        .type = Type::choice,
        .default_text = "\"mean_rotation\"",
        .sentence = "How rotation is taken out of deformations: by the mean of two rotations, or by the mean angle (2-D only).",
        .choices = removals},
};

constexpr std::array region_keys{
    Key{.name = "name",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Name by which materials refer to the region; where regions overlap, the last one counts."},
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

constexpr std::array material_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the material in messages."},
    Key{.name = "regions", .type = Type::names, .need = Need::required, .sentence = "Regions that are made of it."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .need = Need::required,
        .sentence = "Mass per volume."},
    Key{.name = "shear_velocity",
        .type = Type::number,
        .unit = "m/s",
        .range = positive,
        .note = two_of_three,
        .sentence = "Velocity of S waves."},
    Key{.name = "pressure_velocity",
        .type = Type::number,
        .unit = "m/s",
        .range = positive,
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
        .default_text = "0.0",
        .sentence = "Share of critical damping at the frequencies f1 and f2 of [damping]."},
    Key{.name = "cohesion",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .note = "default: the material is elastic and never fails",
        .sentence = "Cohesion of Mohr and Coulomb's strength."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 60},
        .note = with_strength,
        .sentence = "Angle of friction, in the ground and, once links are broken, between particles."},
    Key{.name = "dilation_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 60},
        .default_text = "0.0",
        .note = "only with a cohesion",
        .sentence = "Angle of dilation; at most the friction angle."},
    Key{.name = "tensile_strength",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .default_text = "0.0",
        .note = "only with a cohesion",
        .sentence = "Largest tensile stress; at most cohesion/tan(friction_angle)."},
    Key{.name = "rupture_strain",
        .type = Type::number,
        .range = positive,
        .default_text = "0.1",
        .note = "only with a cohesion",
        .sentence = "Plastic slip (of engineering shear strain) or opening at which links break."},
};

constexpr std::array boundary_keys{
    Key{.name = "side",
        .type = Type::choice,
        .need = Need::required,
        .sentence =
            "Particles without a neighbour in this direction: left and right are x, front and back y in 3-D, bottom and top "
            "the vertical; all takes every particle.",
        .choices = sides},
    Key{.name = "kind",
        .type = Type::choice,
        .need = Need::required,
        .sentence =
            "fixed does not move, roller is held across the side, prescribed moves as given (E + F), viscous lets waves leave "
            "and a wave E enter.",
        .choices = side_kinds},
    Key{.name = "axes",
        .type = Type::axes,
        .default_text = "[]",
        .note = "kind roller only; none: across the side",
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
        .sentence = "Dashpots of contacts between particles whose links broke, over critical ones."},
};

constexpr std::array ground_gravity_keys{
    gravity_keys.front(),
    Key{.name = "settle",
        .type = Type::boolean,
        .default_text = "false",
        .sentence =
            "Begin at rest under gravity: the equilibrium is found first, viscous boundaries carry what they carry in it, and "
            "displacements count from there."},
    Key{.name = "settling_steps",
        .type = Type::integer,
        .range = {.low = 1, .high = 1000000000},
        .default_text = "200000",
        .sentence = "After so many steps without rest the ground is said not to stand."},
};

constexpr std::array noise_keys{
    Key{.name = "velocity",
        .type = Type::number,
        .unit = "m/s",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Largest random velocity of every degree of freedom at the start (of rotations: over half a spacing)."},
    Key{.name = "seed",
        .type = Type::integer,
        .range = {.low = 1, .high = 1000000},
        .default_text = "1",
        .sentence = "Which random numbers are taken."},
};

constexpr std::array gauge_keys{
    gauge_name_key,
    Key{.name = "point",
        .type = Type::vector,
        .unit = "m",
        .need = Need::required,
        .sentence = "Where it is at the start: it takes the motion of the nearest particle, at most a spacing away."},
};

constexpr std::array time_keys{
    end_key,
    Key{.name = "step",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .note = "default: stability_fraction of the predicted limit, or a little less",
        .sentence = "Step of all particles; above the predicted limit the case is refused."},
    Key{.name = "stability_fraction",
        .type = Type::number,
        .range = stability_fraction_range,
        .default_text = "0.9",
        .sentence = "Step over the predicted limit where no step is given."},
    Key{.name = "integrator",
        .type = Type::choice,
        .default_text = "\"verlet\"",
        .sentence = "How a step goes.",
        .choices = integrators},
    history_interval_key,
    snapshot_interval_key,
    strict_key,
};

constexpr std::array tables{
    case_table,
    Table{"particles", false, Need::required, "The lattice on which particles stand.", particle_keys},
    Table{"regions", true, Need::required, "What is filled with particles.", region_keys},
    Table{"materials", true, Need::required, "What the regions are made of.", material_keys},
    Table{"damping", false, Need::optional, "Rayleigh damping: its two frequencies.", damping_keys},
    motions_table,
    Table{"boundaries", true, Need::optional, "How the sides are held; all others are free.", boundary_keys},
    Table{"contact", false, Need::optional, "Contacts of particles whose links broke.", contact_keys},
    Table{"gravity", false, Need::optional, "Body force.", ground_gravity_keys},
    Table{"noise", false, Need::optional, "Small random motion at the start, so that whatever can grow does.", noise_keys},
    Table{"gauges", true, Need::optional, "Points whose motion is recorded.", gauge_keys},
    Table{"time", false, Need::required, "How long, in which steps, and when results are written.", time_keys},
    output_table,
};

}  // namespace

std::span<const Table> mps_schema() { return tables; }

}  // namespace sazare::cases
