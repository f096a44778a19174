#include <algorithm>
#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/cases/format/usual_values.hpp"
#include "sazare/cases/law_keys.hpp"
#include "sazare/cases/water/keys.hpp"
#include "sazare/laws/granular/contact_laws.hpp"
#include "sazare/methods/spheres/case/body_keys.hpp"
#include "sazare/methods/spheres/case/format.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 5> sources{"one", "file", "lattice", "random", "bodies"};
constexpr std::array<std::string_view, 3> level_choices{"automatic", "per_sphere", "uniform"};
constexpr std::array<std::string_view, 3> wall_shapes{"plane", "box", "mesh"};

constexpr Range restitution_range{.low = 0, .high = 1, .low_open = true};
constexpr std::string_view for_elasticity = "required for models hertz, jkr and mindlin_deresiewicz";
constexpr std::string_view of_contact = "default: that of [contact]";
constexpr std::string_view in_region = "required for lattice and random";

constexpr std::array domain_keys{
    Key{.name = "periodic",
        .type = Type::axes,
        .default_text = "[]",
        .sentence = "Axes along which the domain is periodic: what leaves at one end comes in at the other."},
    Key{.name = "lower",
        .type = Type::vector,
        .unit = "m",
        .note = "required where an axis is periodic",
        .sentence = "Lower ends of the periodic axes; the other axes do not count."},
    Key{.name = "upper",
        .type = Type::vector,
        .unit = "m",
        .note = "required where an axis is periodic",
        .sentence = "Upper ends of the periodic axes; the other axes do not count."},
};

constexpr std::array material_keys{
    Key{.name = "name",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Name by which spheres, walls and pairs refer to it."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .usual = usual::density,
        .need = Need::required,
        .sentence = "Mass per volume."},
    Key{.name = "youngs_modulus",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::elastic_modulus,
        .note = for_elasticity,
        .sentence = "Young's modulus."},
    Key{.name = "poisson_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 0.5},
        .note = for_elasticity,
        .sentence = "Poisson's ratio."},
};

/// Keys for the parameters of the contact laws in [[pairs]], where that of [contact] is the default.
consteval auto law_keys_of_pairs() {
  auto keys = keys_of_laws<laws::ContactLaws>();
  for (Key& key : keys) {
    key.note = of_contact;
    key.sentence = "As in [contact].";
  }
  return keys;
}

constexpr std::array leading_contact_keys{
    Key{.name = "model",
        .type = Type::choice,
        .default_text = "\"hertz\"",
        .sentence = "Hertz-Mindlin from the elasticity of the materials, linear springs, the adhesion of Johnson, Kendall and "
                    "Roberts between elastic spheres, or Hertz contacts with partial slip, after Mindlin and Deresiewicz: for "
                    "oblique impacts below some 30 degrees to the normal and small cycles of shear, at a higher cost.",
        .choices = laws::contact_law_words},
    Key{.name = "restitution",
        .type = Type::number,
        .range = restitution_range,
        .need = Need::required,
        .sentence =
            "Coefficient of restitution: relative velocity after a central impact with one contact over that before. A rigid "
            "body that lands on several of its "
            "spheres at once loses more, and fast impacts lose less where the step is too long for them: a warning then says "
            "up to which speed the step is right."},
    Key{.name = "friction_coefficient",
        .type = Type::number,
        .range = not_negative,
        .note = "exactly one of friction_coefficient and friction_angle",
        .sentence = "Coefficient of friction; 0.0 for contacts without friction."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 90, .high_open = true},
        .usual = usual::friction_angle,
        .note = "exactly one of friction_coefficient and friction_angle",
        .sentence = "Angle whose tangent is the coefficient of friction."},
    Key{.name = "rolling_friction",
        .type = Type::number,
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Coefficient of rolling friction: largest moment against rolling over normal force and reduced radius."},
    Key{.name = "twisting_friction",
        .type = Type::number,
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Coefficient of twisting friction: largest moment about the normal over normal force and reduced radius."},
};

constexpr std::array closing_contact_keys{
    Key{.name = "overlap_limit",
        .type = Type::number,
        .range = {.low = 0, .high = 1},
        .default_text = "0.05",
        .sentence = "Largest overlap at the start over the smaller radius; more is refused."},
    Key{.name = "margin",
        .type = Type::number,
        .range = {.low = 0, .high = 10, .low_open = true},
        .default_text = "0.1",
        .sentence = "Spheres nearer than this, over the smallest diameter, are kept as candidate pairs; it changes the computing "
                    "time only, and with levels also the error of the step."},
};

constexpr auto contact_keys = joined(leading_contact_keys, keys_of_laws<laws::ContactLaws>(), closing_contact_keys);

constexpr std::array own_pair_keys{
    Key{.name = "between",
        .type = Type::two_names,
        .need = Need::required,
        .sentence = "The two materials; the same twice for spheres of one."},
    Key{.name = "restitution",
        .type = Type::number,
        .range = restitution_range,
        .note = of_contact,
        .sentence = "As in [contact]."},
    Key{.name = "friction_coefficient",
        .type = Type::number,
        .range = not_negative,
        .note = of_contact,
        .sentence = "As in [contact]."},
    Key{.name = "rolling_friction",
        .type = Type::number,
        .range = not_negative,
        .note = of_contact,
        .sentence = "As in [contact]."},
    Key{.name = "twisting_friction",
        .type = Type::number,
        .range = not_negative,
        .note = of_contact,
        .sentence = "As in [contact]."},
};

constexpr auto pair_keys = joined(own_pair_keys, law_keys_of_pairs());

constexpr std::array sphere_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the group, for gauges and messages."},
    Key{.name = "material", .type = Type::text, .need = Need::required, .sentence = "What it is made of."},
    Key{.name = "source",
        .type = Type::choice,
        .default_text = "\"one\"",
        .sentence =
            "One sphere, a file of them, a cubic lattice in a box, random places in a box without overlap, or rigid bodies, "
            "each with its own spheres, from two files.",
        .choices = sources},
    Key{.name = "centre",
        .type = Type::vector,
        .unit = "m",
        .note = "required for one",
        .sentence = "Where the sphere is at the start."},
    Key{.name = "radius",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .note = "required except for a file, bodies or a shape",
        .sentence = "Radius; of random spheres the smallest, where largest_radius is given."},
    Key{.name = "largest_radius",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .note = "random only; default: radius",
        .sentence = "Largest radius: radii are distributed uniformly between the two, and the largest spheres are placed first."},
    Key{.name = "file",
        .type = Type::file,
        .note = "required for a file and for bodies",
        .sentence = "Rows of radius, x, y, z in m, with blanks, commas or semicolons between them; titles in the first line must "
                    "be those of "
                    "the columns, and lines that begin with # are skipped. Of a shape: rows of x, y, z in m and its rotation "
                    "vector rx, ry, rz "
                    "in rad. Of bodies: rows of the number of a body, and radius, x, y, z of one of its spheres."},
    Key{.name = "bodies_file",
        .type = Type::file,
        .note = "required for bodies",
        .sentence =
            "Rows of body, volume, x, y, z, vx, vy, vz, wx, wy, wz, ixx, iyy, izz, ixy, iyz, izx: its number, volume in m3, "
            "centre of mass in m, velocity in m/s, angular velocity in rad/s, and the matrix of its inertia about that "
            "centre over its density in m5."},
    Key{.name = "lower",
        .type = Type::vector,
        .unit = "m",
        .note = in_region,
        .sentence = "Corner of the box with the smallest coordinates."},
    Key{.name = "upper",
        .type = Type::vector,
        .unit = "m",
        .note = in_region,
        .sentence = "Corner of the box with the largest coordinates."},
    Key{.name = "spacing",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .note = "lattice only; default: the diameter",
        .sentence = "Distance of neighbours on the lattice; as many as fit stand in the middle of the box."},
    Key{.name = "count",
        .type = Type::integer,
        .range = {.low = 1, .high = 50000000},
        .note = "required for random",
        .sentence = "Number of spheres."},
    Key{.name = "seed",
        .type = Type::integer,
        .range = {.low = 1, .high = 1000000},
        .default_text = "1",
        .sentence = "Seed of the random numbers."},
    Key{.name = "velocity", .type = Type::vector, .unit = "m/s", .default_text = "[0.0, 0.0, 0.0]", .sentence = "At the start."},
    Key{.name = "angular_velocity",
        .type = Type::vector,
        .unit = "rad/s",
        .default_text = "[0.0, 0.0, 0.0]",
        .sentence = "Angular velocity at the start."},
    Key{.name = "noise",
        .type = Type::number,
        .unit = "m/s",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Largest random velocity along each axis, beside the velocity."},
    Key{.name = "held",
        .type = Type::boolean,
        .default_text = "false",
        .sentence = "Whether the spheres keep their initial velocity and angular velocity, whatever forces act on them."},
    Key{.name = "lowered",
        .type = Type::boolean,
        .default_text = "false",
        .sentence =
            "Whether each sphere or body in turn is lowered along gravity until it touches a plane or what was placed before, as "
            "units are placed on a quay; how high its place is does not count."},
    Key{.name = "rain",
        .type = Type::boolean,
        .default_text = "false",
        .sentence =
            "Whether the group falls under gravity and comes to rest before the run begins; all others, and the walls, stand "
            "still meanwhile."},
    Key{.name = "drag_coefficient",
        .type = Type::number,
        .range = {.low = 0, .high = 100},
        .usual = {0.1, 5},
        .note = "with [water], whose own is the default",
        .sentence = "Drag coefficient of the group's bodies."},
    Key{.name = "inertia_coefficient",
        .type = Type::number,
        .range = {.low = 1},
        .usual = {1, 3},
        .note = "with [water], whose own is the default",
        .sentence = "Inertia coefficient C_M of the group's bodies."},
    Key{.name = "shape",
        .type = Type::text,
        .note = "none: single spheres",
        .sentence = "Shape of [[shapes]]: the group is of rigid or bonded bodies, places are those of their centres of mass."},
    Key{.name = "rotation",
        .type = Type::vector,
        .unit = "rad",
        .default_text = "[0.0, 0.0, 0.0]",
        .sentence = "Rotation vector of a shape at the start."},
    Key{.name = "random_rotation",
        .type = Type::boolean,
        .default_text = "false",
        .sentence = "Whether every body of a shape has a random orientation instead."},
};

constexpr std::array wall_keys{
    Key{.name = "name",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Name of the wall; its columns in walls.csv begin with it."},
    Key{.name = "material", .type = Type::text, .need = Need::required, .sentence = "What it is made of."},
    Key{.name = "shape",
        .type = Type::choice,
        .default_text = "\"plane\"",
        .sentence = "A plane with spheres on one side, the six planes of a box with spheres inside, or the triangles of a file.",
        .choices = wall_shapes},
    Key{.name = "point",
        .type = Type::vector,
        .unit = "m",
        .note = "required for a plane",
        .sentence = "Any point of the plane."},
    Key{.name = "normal",
        .type = Type::vector,
        .note = "required for a plane",
        .sentence = "Normal of the plane, towards the spheres; of any length."},
    Key{.name = "lower",
        .type = Type::vector,
        .unit = "m",
        .note = "required for a box",
        .sentence = "Corner with the smallest coordinates."},
    Key{.name = "upper",
        .type = Type::vector,
        .unit = "m",
        .note = "required for a box",
        .sentence = "Corner with the largest coordinates."},
    Key{.name = "file",
        .type = Type::file,
        .note = "required for a mesh",
        .sentence = "Triangles: .stl (text or binary) or a Gmsh .msh (format 4.1)."},
    Key{.name = "group",
        .type = Type::text,
        .note = "mesh of a .msh; default: all",
        .sentence = "Physical surface group that is the wall."},
    Key{.name = "scale",
        .type = Type::number,
        .range = positive,
        .default_text = "1.0",
        .sentence = "Length of the file's unit in m."},
    Key{.name = "motion_x", .type = Type::text, .note = "none: at rest", .sentence = "Motion along x."},
    Key{.name = "motion_y", .type = Type::text, .note = "none: at rest", .sentence = "Motion along y."},
    Key{.name = "motion_z", .type = Type::text, .note = "none: at rest", .sentence = "Motion along z."},
    Key{.name = "angular_velocity",
        .type = Type::vector,
        .unit = "rad/s",
        .default_text = "[0.0, 0.0, 0.0]",
        .sentence = "Constant angular velocity about the pivot."},
    Key{.name = "pivot",
        .type = Type::vector,
        .unit = "m",
        .default_text = "[0.0, 0.0, 0.0]",
        .sentence = "A point of the axis of rotation, at the start."},
};

constexpr std::array gauge_keys{
    gauge_name_key,
    Key{.name = "group",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Group of spheres whose centre of mass is recorded."},
};

constexpr std::array time_keys{
    end_key,
    Key{.name = "step",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .note = "default: stability_fraction of the limit, or a little less",
        .sentence = "Time step of all spheres; above the stability limit the case is refused."},
    Key{.name = "levels",
        .type = Type::choice,
        .default_text = "\"automatic\"",
        .sentence = "Whether every sphere, or every clump, has its own time level, or all take the smallest stable step of any. "
                    "Automatic takes levels where spheres then need less than half of the steps, no step is given, and "
                    "nothing is coupled.",
        .choices = level_choices},
    Key{.name = "stability_fraction",
        .type = Type::number,
        .range = stability_fraction_range,
        .default_text = "0.2",
        .sentence = "Ratio of the step to the stability limit where no step is given: the Rayleigh time step of the smallest "
                    "sphere, or with linear springs "
                    "2/frequency of a contact, or the limit of the bonds; with levels each sphere's own."},
    history_interval_key,
    snapshot_interval_key,
    strict_key,
};

constexpr std::array tables{
    case_table,
    Table{"domain", false, Need::optional, "The periodic domain.", domain_keys},
    Table{"materials", true, Need::required, "What spheres and walls are made of.", material_keys},
    Table{"contact", false, Need::required, "The contact law of spheres and walls.", contact_keys},
    Table{"pairs", true, Need::optional, "Contact properties of two given materials, where they differ from [contact].",
          pair_keys},
    Table{"shapes", true, Need::optional, "Bodies made of spheres, rigid or bonded.", shape_keys},
    Table{"spheres", true, Need::required, "Groups of spheres.", sphere_keys},
    Table{"bonds", true, Need::optional, "Which spheres are bonded, and how strongly.", bond_keys},
    Table{"walls", true, Need::optional,
          "Planes and surfaces that spheres cannot pass. Those of one material and one motion are one surface.", wall_keys},
    Table{"motions", true, Need::optional, "Histories of the walls' motion.", motion_keys},
    gravity_table,
    water_table,
    Table{"gauges", true, Need::optional, "Groups whose motion is recorded.", gauge_keys},
    Table{"time", false, Need::required, "How long, in which steps, and when results are written.", time_keys},
    output_table,
};

}  // namespace

std::span<const Table> spheres_schema() { return tables; }

}  // namespace sazare::cases
