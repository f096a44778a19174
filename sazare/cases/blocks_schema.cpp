#include <array>

#include "sazare/cases/case_keys.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 3> damping_caps{"literal", "critical", "step"};
constexpr std::array<std::string_view, 3> boundary_kinds{"fixed", "frictionless", "absorbing"};
constexpr std::array<std::string_view, 2> level_choices{"per_element", "uniform"};
constexpr std::array<std::string_view, 3> limiters{"stability", "travel", "none"};

constexpr std::string_view when_bonded = "required when bonded";
constexpr std::string_view geo_only = "only for a .geo file";

constexpr std::array mesh_keys{
    Key{.name = "file",
        .type = Type::file,
        .need = Need::required,
        .sentence =
            "Gmsh mesh (.msh, format 4.1) or geometry (.geo, meshed by gmsh when the case is run), relative "
            "to the case file."},
    Key{.name = "scale",
        .type = Type::number,
        .range = positive,
        .default_text = "1.0",
        .sentence = "Factor on all coordinates, such as 0.001 for a mesh in millimetres."},
    Key{.name = "size_factor",
        .type = Type::number,
        .range = positive,
        .default_text = "1.0",
        .note = geo_only,
        .sentence = "Factor on all element sizes (gmsh -clscale)."},
    Key{.name = "parameters",
        .type = Type::numbers,
        .default_text = "{}",
        .note = geo_only,
        .sentence = "Values for constants that the geometry declares with DefineConstant (gmsh -setnumber)."},
};

constexpr std::array material_keys{
    Key{.name = "name",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Name by which joints refer to the material."},
    Key{.name = "regions",
        .type = Type::names,
        .need = Need::required,
        .sentence = "Physical volume groups of the mesh that are made of it."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .need = Need::required,
        .sentence = "Mass per volume."},
};

constexpr std::array joint_keys{
    Key{.name = "name",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Name of the joint in results and messages."},
    Key{.name = "between",
        .type = Type::two_names,
        .note = "exactly one of between and surface",
        .sentence =
            "The two materials (the same one twice for faces inside a material) whose shared faces it "
            "joins."},
    Key{.name = "surface",
        .type = Type::text,
        .note = "exactly one of between and surface",
        .sentence = "Physical surface group inside the body whose faces it joins, such as a fault."},
    Key{.name = "bonded",
        .type = Type::boolean,
        .default_text = "true",
        .sentence = "False for faces that never were bonded, such as an existing crack or a slit."},
    Key{.name = "normal_stiffness",
        .type = Type::number,
        .unit = "Pa/m",
        .range = positive,
        .note = when_bonded,
        .sentence = "Normal stress per opening."},
    Key{.name = "shear_stiffness",
        .type = Type::number,
        .unit = "Pa/m",
        .range = not_negative,
        .note = when_bonded,
        .sentence = "Shear stress per elastic slip."},
    Key{.name = "normal_damping",
        .type = Type::number,
        .unit = "Pa s/m",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Normal stress per opening velocity (dashpot)."},
    Key{.name = "shear_damping",
        .type = Type::number,
        .unit = "Pa s/m",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Shear stress per slip velocity (dashpot)."},
    Key{.name = "cohesion",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .note = when_bonded,
        .sentence = "Shear strength without normal stress."},
    Key{.name = "friction_coefficient",
        .type = Type::number,
        .range = not_negative,
        .note = "when bonded, exactly one of friction_coefficient and friction_angle",
        .sentence = "Shear strength per compressive stress."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 90, .high_open = true},
        .note = "when bonded, exactly one of friction_coefficient and friction_angle",
        .sentence = "Angle whose tangent is the friction coefficient."},
    Key{.name = "tensile_strength",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .note = when_bonded,
        .sentence =
            "Normal stress at which softening begins; at most sqrt(2 fracture_energy normal_stiffness)."},
    Key{.name = "fracture_energy",
        .type = Type::number,
        .unit = "N/m",
        .range = positive,
        .note = when_bonded,
        .sentence = "Energy per area that opening the joint in tension takes."},
};

constexpr std::array contact_keys{
    Key{.name = "normal_stiffness",
        .type = Type::number,
        .unit = "N/m",
        .range = positive,
        .need = Need::required,
        .sentence = "Force per overlap of a pair of contact spheres."},
    Key{.name = "normal_damping",
        .type = Type::number,
        .unit = "N s/m",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Force per approach velocity of a pair (dashpot); never attracts."},
    Key{.name = "friction_coefficient",
        .type = Type::number,
        .range = not_negative,
        .note = "exactly one of friction_coefficient and friction_angle",
        .sentence = "Largest tangential force per normal force."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 90, .high_open = true},
        .note = "exactly one of friction_coefficient and friction_angle",
        .sentence = "Angle whose tangent is the friction coefficient."},
    Key{.name = "damping_cap",
        .type = Type::choice,
        .default_text = "\"step\"",
        .sentence =
            "How a dashpot too stiff for the masses acts: literal as given, at most critical, or built up over "
            "the steps as fast as they bear.",
        .choices = damping_caps},
    Key{.name = "edge_division",
        .type = Type::integer,
        .range = {.low = 3, .high = 20},
        .default_text = "5",
        .sentence =
            "Contact spheres sit at the interior points when each edge of a face is divided into this many "
            "equal parts."},
};

constexpr std::array blast_keys{
    Key{.name = "name",
        .type = Type::text,
        .note = "default: the surface's name",
        .sentence = "Name of the hole in results and messages."},
    Key{.name = "surface",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Physical surface group of the hole's wall."},
    Key{.name = "delay",
        .type = Type::number,
        .unit = "s",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Time at which the pressure begins."},
    Key{.name = "peak_pressure",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .note = "required without table",
        .sentence = "Largest pressure P0 of the pulse."},
    Key{.name = "rise_time",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .note = "required without table",
        .sentence = "Time a from zero to the largest pressure."},
    Key{.name = "decay_ratio",
        .type = Type::number,
        .range = positive,
        .note = "required without table",
        .sentence = "Time b from the largest pressure to zero, over the rise time."},
    Key{.name = "table",
        .type = Type::file,
        .note = "instead of peak_pressure, rise_time and decay_ratio",
        .sentence =
            "CSV file with header \"time [s],pressure [Pa]\" and times that increase; linear between rows."},
    Key{.name = "cut_distance",
        .type = Type::number,
        .unit = "m",
        .range = positive_or_infinite,
        .default_text = "inf",
        .sentence = "The pressure on a face ends for good once the face has moved this far; inf: never."},
};

constexpr std::array boundary_keys{
    Key{.name = "surface",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Physical surface group on the outside of the body."},
    Key{.name = "kind",
        .type = Type::choice,
        .need = Need::required,
        .sentence =
            "fixed does not move, frictionless slides along the plane of each face, absorbing lets waves "
            "leave (dashpots).",
        .choices = boundary_kinds},
};

constexpr std::array constraint_keys{
    Key{.name = "regions",
        .type = Type::names,
        .need = Need::required,
        .sentence = "Physical volume groups whose elements are held."},
    Key{.name = "translation",
        .type = Type::axes,
        .default_text = "[]",
        .sentence = "Axes along which the elements cannot move."},
    Key{.name = "rotation",
        .type = Type::axes,
        .default_text = "[]",
        .sentence = "Axes about which the elements cannot turn."},
};

constexpr std::array initial_velocity_keys{
    Key{.name = "regions",
        .type = Type::names,
        .need = Need::required,
        .sentence = "Physical volume groups that move at the start."},
    Key{.name = "velocity",
        .type = Type::vector,
        .unit = "m/s",
        .need = Need::required,
        .sentence = "Their velocity at the start."},
};

constexpr std::array gauge_keys{
    gauge_name_key,
    Key{.name = "point",
        .type = Type::vector,
        .unit = "m",
        .need = Need::required,
        .sentence = "Where it is fixed to the body at the start: a point inside an element."},
};

constexpr std::array time_keys{
    end_key,
    Key{.name = "levels",
        .type = Type::choice,
        .default_text = "\"per_element\"",
        .sentence = "Whether every element has its own time level, or all take the finest that any asks for.",
        .choices = level_choices},
    Key{.name = "limiter",
        .type = Type::choice,
        .default_text = "\"stability\"",
        .sentence =
            "What sets the step of an element: its own stable step, the distance it travels in a step, or "
            "nothing (base_step for all).",
        .choices = limiters},
    Key{.name = "base_step",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .note = "default: chosen from the stable steps; required for limiter travel and none",
        .sentence = "The largest step; level k steps base_step / 2^k."},
    Key{.name = "stability_fraction",
        .type = Type::number,
        .range = {.low = 0, .high = 1, .low_open = true},
        .default_text = "0.5",
        .sentence =
            "Step of an element over the limit of its own springs and dashpots with its neighbours held; 0.5 "
            "allows for neighbours that move as well."},
    Key{.name = "travel_length",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .default_text = "10e-9",
        .sentence = "Largest distance an element travels in a step (limiter travel)."},
    Key{.name = "neighbor_levels",
        .type = Type::integer,
        .range = {.low = 0, .high = 20},
        .default_text = "2",
        .sentence = "Largest difference of level between elements that are linked."},
    history_interval_key,
    snapshot_interval_key,
    Key{.name = "strict",
        .type = Type::boolean,
        .default_text = "false",
        .sentence = "Refuse what would only be warned about, such as a step above the stable one."},
};

constexpr std::array tables{
    case_table,
    Table{"mesh", false, Need::required, "The body: tetrahedra with named volumes and surfaces.", mesh_keys},
    Table{"materials", true, Need::required, "What the named volumes are made of.", material_keys},
    Table{"joints", true, Need::required,
          "How faces hold together; where several entries match a face, the last one wins.", joint_keys},
    Table{"contact", false, Need::required, "What acts between faces after failure and between free faces.",
          contact_keys},
    Table{"blasts", true, Need::optional,
          "Pressure on the walls of holes: a pulse, or a table from a CSV file.", blast_keys},
    gravity_table,
    Table{"boundaries", true, Need::optional, "How outer faces are held; all others are free.",
          boundary_keys},
    Table{"constraints", true, Need::optional, "Axes along or about which whole volumes cannot move.",
          constraint_keys},
    Table{"initial_velocities", true, Need::optional, "Volumes that move at the start.",
          initial_velocity_keys},
    Table{"gauges", true, Need::optional, "Points whose velocity is recorded.", gauge_keys},
    Table{"time", false, Need::required, "How long, in which steps, and when results are written.",
          time_keys},
    output_table,
};

}  // namespace

std::span<const Table> blocks_schema() { return tables; }

}  // namespace sazare::cases
