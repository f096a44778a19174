#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/cases/format/usual_values.hpp"
#include "sazare/methods/fem/case/format.hpp"
#include "sazare/methods/fem/case/material_keys.hpp"
#include "sazare/methods/fem/case/member_keys.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 2> mass_kinds{"consistent", "lumped"};
constexpr std::array<std::string_view, 2> integrations{"full", "reduced"};
constexpr std::array<std::string_view, 5> group_kinds{"fixed", "roller", "prescribed", "viscous", "free_field"};
constexpr std::array<std::string_view, 2> added_masses{"none", "westergaard"};
constexpr std::array<std::string_view, 3> incident_wave_kinds{"sv", "sh", "p"};
constexpr std::array<std::string_view, 2> analyses{"dynamic", "static"};

constexpr std::string_view with_motion = "kinds prescribed and viscous only";

constexpr std::array fem_mesh_keys{
    mesh_keys[0],
    mesh_keys[1],
    mesh_keys[2],
    mesh_keys[3],
    Key{.name = "dimension",
        .type = Type::integer,
        .range = {.low = 2, .high = 3},
        .default_text = "2",
        .sentence = "2 for plane strain in x and y (up), with forces per metre out of plane; 3 for a body in x, y and z (up)."},
};

constexpr std::array element_keys{
    Key{.name = "mass",
        .type = Type::choice,
        .default_text = "\"consistent\"",
        .sentence = "Mass matrix: consistent, or lumped at the nodes.",
        .choices = mass_kinds},
    Key{.name = "integration",
        .type = Type::choice,
        .default_text = "\"full\"",
        .sentence = "Integration of the stiffness: full, or reduced, with fewer points in 8-node quadrilaterals and 20-node "
                    "hexahedra, which avoids locking in bending and plastic flow.",
        .choices = integrations},
};

constexpr std::array joint_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the joint in results and messages."},
    Key{.name = "between",
        .type = Type::two_names,
        .note = "exactly one of between and group",
        .sentence = "The two regions between whose shared faces the joint lies."},
    Key{.name = "group",
        .type = Type::text,
        .note = "exactly one of between and group",
        .sentence = "Physical group of faces inside the body (lines in 2-D) along which the joint lies."},
    Key{.name = "joint_normal_stiffness",
        .type = Type::number,
        .unit = "Pa/m",
        .range = positive,
        .usual = usual::stiffness_per_area,
        .need = Need::required,
        .sentence = "Normal stiffness: pressure per overlap of the faces."},
    Key{.name = "joint_shear_stiffness",
        .type = Type::number,
        .unit = "Pa/m",
        .range = positive,
        .usual = usual::stiffness_per_area,
        .need = Need::required,
        .sentence = "Shear stiffness: shear stress per elastic shear displacement."},
    Key{.name = "cohesion",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .usual = usual::strength,
        .default_text = "0.0",
        .sentence = "Cohesion: shear strength at zero pressure, where the faces touch."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 89},
        .usual = usual::friction_angle,
        .need = Need::required,
        .sentence = "Friction angle between the faces."},
};

constexpr std::array boundary_keys{
    Key{.name = "group",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Physical group of the mesh to whose nodes it applies: faces, lines or points."},
    Key{.name = "kind",
        .type = Type::choice,
        .need = Need::required,
        .sentence = "fixed: held along all axes; roller: held along some; prescribed: moved along the axes that have a motion; "
                    "viscous: lets waves leave and incident waves enter; free_field: a vertical side that follows a column of "
                    "its own layers on the same base, and lets waves leave (both for groups of faces only).",
        .choices = group_kinds},
    Key{.name = "axes",
        .type = Type::axes,
        .default_text = "[]",
        .note = "required for a roller",
        .sentence = "Axes along which a roller is held; for kind prescribed, those that are held without a motion."},
    Key{.name = "motion_x", .type = Type::text, .note = with_motion, .sentence = "Motion along x."},
    Key{.name = "motion_y", .type = Type::text, .note = with_motion, .sentence = "Motion along y."},
    Key{.name = "motion_z", .type = Type::text, .note = with_motion, .sentence = "Motion along z."},
};

constexpr std::array incident_wave_keys{
    Key{.name = "kind",
        .type = Type::choice,
        .need = Need::required,
        .sentence = "sv: shear wave whose motion lies in the vertical plane in which it travels, towards x and down for an angle "
                    "above 0; sh: shear wave whose motion is horizontal and across that plane (3-D only); p: compression wave.",
        .choices = incident_wave_kinds},
    Key{.name = "motion",
        .type = Type::text,
        .need = Need::required,
        .sentence =
            "Name of one of the [[motions]]: that of the ground in the incident wave alone, along its direction of motion, "
            "where the wave reaches the base first. Half of what outcropping rock does, if the wave comes up vertically."},
    Key{.name = "angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = -89, .high = 89},
        .need = Need::required,
        .sentence =
            "Angle from the vertical at which the wave travels in the ground at the base; above 0 towards x, or along the "
            "azimuth. Below the critical angle of all layers."},
    Key{.name = "azimuth",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = -180, .high = 180},
        .default_text = "0.0",
        .note = "3-D only",
        .sentence = "Horizontal direction in which the wave travels, from x towards y."},
};

constexpr std::array tie_keys{
    Key{.name = "group",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Physical group of one side: faces, lines or points."},
    Key{.name = "opposite",
        .type = Type::text,
        .need = Need::required,
        .sentence =
            "Physical group of the other side, with a node opposite every node of the group: the two move as one, like sides "
            "of ground that goes on alike."},
};

constexpr std::array load_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the load in messages."},
    Key{.name = "group",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Physical group of outer faces (lines in 2-D) on which it acts."},
    Key{.name = "traction",
        .type = Type::vector,
        .unit = "Pa",
        .need = Need::required,
        .sentence = "Traction: force per area; z is 0 in 2-D."},
    Key{.name = "ramp",
        .type = Type::number,
        .unit = "s",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Time in which the load grows linearly from 0 to its full value; 0: applied at once at t = 0."},
};

constexpr std::array water_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the water in results and messages."},
    Key{.name = "group",
        .type = Type::text,
        .note = "exactly one of group and joint",
        .sentence = "Physical group of outer faces (lines in 2-D) on which it presses."},
    Key{.name = "joint",
        .type = Type::text,
        .note = "exactly one of group and joint",
        .sentence =
            "Name of one of the [[joints]] in which it stands: it pushes both sides apart, and the joint carries what is left, "
            "the effective pressure."},
    Key{.name = "level",
        .type = Type::number,
        .unit = "m",
        .need = Need::required,
        .sentence = "Elevation of the still water, y in 2-D and z in 3-D: the pressure is density g (level - elevation) below it "
                    "and 0 above; g is that of [gravity]."},
    Key{.name = "far_level",
        .type = Type::number,
        .unit = "m",
        .note = "default: the level everywhere; for the faces of a base, and for joints",
        .sentence = "Uplift: the level at the far end of a base. The level falls evenly from one end to the other."},
    Key{.name = "direction",
        .type = Type::vector,
        .default_text = "[1.0, 0.0, 0.0]",
        .note = "only with far_level",
        .sentence =
            "Horizontal direction from the end of the base with level to the one with far_level; the default is along x."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .usual = water_density,
        .default_text = "1000.0",
        .sentence = "Density of the water; of sea water about 1030."},
    Key{.name = "ramp",
        .type = Type::number,
        .unit = "s",
        .range = not_negative,
        .default_text = "0.0",
        .sentence =
            "Time in which the pressure grows linearly from 0 to its full value; 0: it is there at t = 0, and settle includes "
            "it."},
    Key{.name = "added_mass",
        .type = Type::choice,
        .default_text = "\"none\"",
        .sentence = "Mass of water that moves with the faces, across them: none, or Westergaard's for steep walls, 7/8 density "
                    "sqrt(H y) per area, with the depth H of the water and the depth y below the level.",
        .choices = added_masses},
    Key{.name = "bed",
        .type = Type::number,
        .unit = "m",
        .note = "westergaard only; default: the lowest point of the group",
        .sentence = "Elevation of the bed of the water, from which H counts."},
};

constexpr std::array drain_keys{
    Key{.name = "group",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Physical group of faces (lines in 2-D) through which water leaves saturated ground with drainage flow: the "
                    "excess pore pressure is 0 there. The water table, faces under [[water_pressures]], and ground with "
                    "drainage drained beside it drain by themselves; all other sides are impervious."},
};

constexpr std::array fem_gravity_keys{
    gravity_keys.front(),
    Key{.name = "settle",
        .type = Type::boolean,
        .default_text = "false",
        .sentence = "Begin in equilibrium under gravity and the pressure of water: it is found first, viscous boundaries and "
                    "free-field sides keep carrying their reactions in it, and displacements count from it."},
};

constexpr std::array solver_keys{
    Key{.name = "tolerance",
        .type = Type::number,
        .range = {.low = 1e-13, .high = 1e-2},
        .default_text = "1e-8",
        .sentence = "Convergence: unbalanced force divided by the largest of the internal, external and inertial forces."},
    Key{.name = "max_iterations",
        .type = Type::integer,
        .range = {.low = 1, .high = 1000},
        .default_text = "20",
        .sentence = "Maximum Newton iterations per step."},
    Key{.name = "max_cuts",
        .type = Type::integer,
        .range = {.low = 0, .high = 20},
        .default_text = "8",
        .sentence = "Maximum number of times that a step that does not converge is halved."},
};

constexpr std::array gauge_keys{
    gauge_name_key,
    Key{.name = "point",
        .type = Type::vector,
        .unit = "m",
        .need = Need::required,
        .sentence = "Initial position: the gauge records the motion of the nearest node."},
};

constexpr std::array time_keys{
    end_key,
    Key{.name = "step",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .need = Need::required,
        .sentence = "Time step; the implicit step is unconditionally stable, so choose it by the frequencies of interest."},
    Key{.name = "analysis",
        .type = Type::choice,
        .default_text = "\"dynamic\"",
        .sentence =
            "dynamic, or static: each step is an equilibrium, and time only parametrises loads and motions, and the flow of "
            "pore water.",
        .choices = analyses},
    Key{.name = "alpha",
        .type = Type::number,
        .range = {.low = -1.0 / 3, .high = 0},
        .default_text = "0.0",
        .note = "dynamic only",
        .sentence = "Parameter of HHT-alpha: negative values add numerical damping of high frequencies; 0 is Newmark's constant "
                    "average acceleration."},
    history_interval_key,
    snapshot_interval_key,
    strict_key,
};

constexpr std::array tables{
    case_table,
    Table{"mesh", false, Need::required, "The body.", fem_mesh_keys},
    Table{"elements", false, Need::optional, "Mass matrix and numerical integration.", element_keys},
    Table{"materials", true, Need::required, "Materials of the regions.", material_keys},
    Table{"joints", true, Need::optional, "Zero-thickness interfaces that slip and open.", joint_keys},
    Table{"damping", false, Need::optional, "Rayleigh damping: its two frequencies.", damping_keys},
    motions_table,
    Table{"boundaries", true, Need::optional, "Boundary conditions of groups; all other nodes are free.", boundary_keys},
    Table{"incident_wave", false, Need::optional,
          "Plane wave that comes in at an angle, through all viscous and free-field boundaries.", incident_wave_keys},
    Table{"ties", true, Need::optional, "Opposite sides whose nodes have their displacement in common.", tie_keys},
    Table{"loads", true, Need::optional, "Tractions on outer faces.", load_keys},
    Table{"water_pressures", true, Need::optional, "Pressure of still water on outer faces, and in joints.", water_keys},
    Table{"members", true, Need::optional, "Beams, bars, springs and dashpots between nodes.", member_keys},
    Table{"drains", true, Need::optional, "Faces at which pore water is free to flow out and in.", drain_keys},
    Table{"gravity", false, Need::optional, "Body force.", fem_gravity_keys},
    Table{"solver", false, Need::optional, "Convergence of the Newton iteration and step cuts.", solver_keys},
    Table{"gauges", true, Need::optional, "Points whose motion is recorded.", gauge_keys},
    Table{"time", false, Need::required, "Duration, time step and intervals of output.", time_keys},
    output_table,
};

}  // namespace

std::span<const Table> fem_schema() { return tables; }

}  // namespace sazare::cases
