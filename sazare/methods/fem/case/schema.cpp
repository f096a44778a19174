#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/cases/format/usual_values.hpp"
#include "sazare/methods/fem/case/format.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 2> mass_kinds{"consistent", "lumped"};
constexpr std::array<std::string_view, 2> integrations{"full", "reduced"};
constexpr std::array<std::string_view, 5> group_kinds{"fixed", "roller", "prescribed", "viscous", "free_field"};
constexpr std::array<std::string_view, 3> backbones{"hyperbolic", "ramberg_osgood", "table"};
constexpr std::array<std::string_view, 3> drainages{"drained", "undrained", "flow"};
constexpr std::array<std::string_view, 4> member_kinds{"beam", "bar", "spring", "dashpot"};
constexpr std::array<std::string_view, 2> added_masses{"none", "westergaard"};
constexpr std::array<std::string_view, 2> analyses{"dynamic", "static"};

constexpr std::string_view with_strength = "only with a cohesion";
constexpr UsualRange water_density{990, 1050};  // [kg/m3]
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

constexpr std::array material_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the material in messages."},
    Key{.name = "regions",
        .type = Type::names,
        .need = Need::required,
        .sentence = "Physical groups of the mesh that consist of the material: surfaces in 2-D, volumes in 3-D."},
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
        .need = Need::required,
        .sentence = "Young's modulus."},
    Key{.name = "poisson_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 0.5, .high_open = true},
        .need = Need::required,
        .sentence = "Poisson's ratio."},
    Key{.name = "damping_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 2},
        .default_text = "0.0",
        .sentence = "Damping ratio at the frequencies f1 and f2 of [damping]."},
    Key{.name = "water_table",
        .type = Type::number,
        .unit = "m",
        .note = "default: no water in the pores",
        .sentence =
            "Elevation of the water table, y in 2-D and z in 3-D: below it the ground has saturated_density and a hydrostatic "
            "pore pressure, and its strength and stiffness are those of the effective stress."},
    Key{.name = "saturated_density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .usual = usual::density,
        .note = "required with a water_table",
        .sentence = "Density of the ground below the water table, with the water in its pores."},
    Key{.name = "pore_water_density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .usual = water_density,
        .default_text = "1000.0",
        .note = "only with a water_table",
        .sentence = "Density of the water in the pores."},
    Key{.name = "drainage",
        .type = Type::choice,
        .default_text = "\"drained\"",
        .note = "only with a water_table",
        .sentence = "drained: the pore pressure stays hydrostatic; undrained: the water moves with the ground, and its pressure "
                    "follows the volume; flow: it also flows through the pores (consolidation), with Darcy's law.",
        .choices = drainages},
    Key{.name = "porosity",
        .type = Type::number,
        .range = {.low = 0, .high = 1, .low_open = true, .high_open = true},
        .usual = {0.1, 0.7},
        .note = "required for drainage undrained and flow",
        .sentence = "Volume of the pores per volume of the ground."},
    Key{.name = "water_bulk_modulus",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = {1e7, 3e9},
        .default_text = "2.2e9",
        .note = "drainage undrained and flow",
        .sentence = "Bulk modulus of the water in the pores; a little air lowers it much."},
    Key{.name = "hydraulic_conductivity",
        .type = Type::number,
        .unit = "m/s",
        .range = positive,
        .usual = {1e-12, 1},
        .note = "required for drainage flow",
        .sentence = "Coefficient of permeability k of Darcy's law, the velocity of flow under a gradient of 1: gravel some 1e-2, "
                    "sand 1e-4, silt 1e-6, clay below 1e-8 m/s."},
    Key{.name = "cohesion",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .usual = usual::strength,
        .note = "default: the material is elastic and never yields",
        .sentence = "Cohesion of the Mohr-Coulomb strength."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 60},
        .usual = {usual::friction_angle.low, 60},
        .note = "required with a cohesion",
        .sentence = "Friction angle."},
    Key{.name = "dilation_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 60},
        .default_text = "0.0",
        .note = with_strength,
        .sentence = "Dilation angle; at most the friction angle."},
    Key{.name = "tensile_strength",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .usual = usual::strength,
        .note = "only with a cohesion; default: cohesion/tan(friction_angle), without friction none",
        .sentence = "Tension cut-off: largest tensile stress; at most cohesion/tan(friction_angle)."},
    Key{.name = "blow_count",
        .type = Type::number,
        .range = {.low = 0, .high = 100, .low_open = true},
        .usual = {3, 50},
        .note = "with a cohesion; not with contraction_rate; default: cycles of shear take no volume",
        .sentence =
            "Sand that contracts under cycles of shear (Byrne 1991), by the blow count (N1)60 of the standard penetration "
            "test: contraction_rate = 8.7 (N1)60^-1.25."},
    Key{.name = "contraction_rate",
        .type = Type::number,
        .range = {.low = 0, .high = 10, .low_open = true},
        .usual = {0.01, 2},
        .note = "with a cohesion; not with blow_count",
        .sentence = "C1 of the contraction C1 g/2 exp(-C2 e/g) in a half cycle of shear strain g after a contraction e; C2 is "
                    "0.4/C1."},
    Key{.name = "contraction_threshold",
        .type = Type::number,
        .range = {.low = 0, .high = 0.1},
        .default_text = "1e-4",
        .note = "only with blow_count or contraction_rate",
        .sentence = "Amplitude of shear strain up to which a half cycle takes no volume."},
    Key{.name = "backbone",
        .type = Type::choice,
        .note = "default: the stiffness does not depend on the strain; not with a cohesion",
        .sentence =
            "Soil that degrades with shear strain and dissipates by Masing's rules: stress of a first loading in shear, a "
            "hyperbola, the curve of Ramberg and Osgood, or a table of G/G0. G0 follows from Young's modulus and Poisson's "
            "ratio.",
        .choices = backbones},
    Key{.name = "reference_strain",
        .type = Type::number,
        .range = {.low = 0, .high = 1, .low_open = true},
        .usual = usual::reference_strain,
        .note = "hyperbolic and ramberg_osgood; default of hyperbolic: shear_strength/G0",
        .sentence = "Shear strain at which G/G0 = 0.5."},
    Key{.name = "shear_strength",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::strength,
        .note =
            "with a backbone; required for ramberg_osgood; default of hyperbolic: G0 reference_strain, of a table: the stress of "
            "its last row",
        .sentence = "Shear strength, at which the backbone ends."},
    Key{.name = "ramberg_osgood_exponent",
        .type = Type::number,
        .range = {.low = 1, .high = 20, .low_open = true},
        .note = "required for ramberg_osgood",
        .sentence = "Exponent r of strain = stress/G0 (1 + (2 stress/(G0 reference_strain))^(r - 1))."},
    Key{.name = "modulus_reduction",
        .type = Type::file,
        .note = "required for a table",
        .sentence =
            "CSV with the header \"shear_strain [-],modulus_ratio [-]\", strains in - or %: G/G0 falls from 1. A third column "
            "\"damping_ratio [-]\" (or %) is only compared with what Masing's rules give."},
    Key{.name = "yield_surfaces",
        .type = Type::integer,
        .range = {.low = 3, .high = 200},
        .default_text = "30",
        .note = "hyperbolic and ramberg_osgood",
        .sentence =
            "Number of elastic-perfectly plastic parts, which are the corners of the backbone; a table has one for each row."},
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

constexpr std::array member_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the member in results and messages."},
    Key{.name = "kind",
        .type = Type::choice,
        .need = Need::required,
        .sentence =
            "beam: bends and stretches (Euler and Bernoulli); bar: stretches only, such as an anchor; spring and dashpot: "
            "along the line between two nodes.",
        .choices = member_kinds},
    Key{.name = "group",
        .type = Type::text,
        .note = "either group, or from and to",
        .sentence = "Physical group of lines of the mesh, along which the member runs from node to node."},
    Key{.name = "from",
        .type = Type::vector,
        .unit = "m",
        .note = "either group, or from and to",
        .sentence = "One end of a straight member: the nearest node, which must be within 1 % of the extent of the mesh."},
    Key{.name = "to", .type = Type::vector, .unit = "m", .note = "either group, or from and to", .sentence = "The other end."},
    Key{.name = "spacing",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .default_text = "1.0",
        .note = "2-D only",
        .sentence =
            "Distance of such members across the plane: section, mass, prestress, stiffness and damping of each are divided "
            "by it, and forces in results are per metre."},
    Key{.name = "youngs_modulus",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .note = "required for beams and bars",
        .sentence = "Young's modulus."},
    Key{.name = "area",
        .type = Type::number,
        .unit = "m2",
        .range = positive,
        .note = "required for beams and bars",
        .sentence = "Area of the section."},
    Key{.name = "second_moment",
        .type = Type::number,
        .unit = "m4",
        .range = positive,
        .note = "required for beams",
        .sentence = "Second moment of area against bending, in space the same in all directions (a round or square section)."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = not_negative,
        .default_text = "0.0",
        .note = "beams and bars; required for beams, where it is above 0",
        .sentence = "Mass per volume."},
    Key{.name = "damping_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 1, .high_open = true},
        .default_text = "0.0",
        .note = "beams and bars",
        .sentence = "Damping ratio of Rayleigh damping at the two frequencies of [damping]."},
    Key{.name = "prestress",
        .type = Type::number,
        .unit = "N",
        .default_text = "0.0",
        .note = "bars only",
        .sentence = "Tension of a bar before the body gives way to it; settle includes it."},
    Key{.name = "stiffness",
        .type = Type::number,
        .unit = "N/m",
        .range = positive,
        .note = "required for springs",
        .sentence = "Force per elongation."},
    Key{.name = "damping",
        .type = Type::number,
        .unit = "N s/m",
        .range = positive,
        .note = "required for dashpots",
        .sentence = "Force per velocity of elongation."},
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
