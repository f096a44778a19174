#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/cases/format/usual_values.hpp"
#include "sazare/cases/law_keys.hpp"
#include "sazare/cases/water/keys.hpp"
#include "sazare/laws/joint_laws.hpp"
#include "sazare/methods/blocks/case/charge_keys.hpp"
#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/methods/blocks/case/ground_keys.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 3> damping_caps{"literal", "critical", "step"};
constexpr std::array<std::string_view, 2> contact_shapes{"spheres", "faces"};
constexpr std::array<std::string_view, 4> boundary_kinds{"fixed", "frictionless", "absorbing", "prescribed"};
constexpr std::string_view with_motion = "not for kind fixed";
constexpr std::array<std::string_view, 2> level_choices{"per_element", "uniform"};
constexpr std::array<std::string_view, 3> limiters{"stability", "travel", "none"};

constexpr std::string_view when_bonded = "required when bonded, not for law barton_bandis";
constexpr std::string_view one_friction =
    "when bonded, exactly one of friction_coefficient and friction_angle, not for law barton_bandis";
constexpr std::string_view without_moduli = "required when bonded, unless its materials have youngs_modulus";
constexpr std::string_view with_poisson_ratio = "with poisson_ratio, instead of the stiffnesses of joints";
constexpr std::string_view with_young_modulus = "with youngs_modulus, instead of the stiffnesses of joints";

constexpr std::array material_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name by which joints refer to the material."},
    Key{.name = "regions",
        .type = Type::names,
        .need = Need::required,
        .sentence = "Physical volume groups of the mesh that consist of the material."},
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
        .usual = usual::rock_modulus,
        .note = with_poisson_ratio,
        .sentence =
            "Young's modulus. With it the springs of each face follow from the two elements beside it, and waves run at one "
            "speed in elements of any size."},
    Key{.name = "poisson_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = laws::most_poisson_ratio_of_deformable},
        .note = with_young_modulus,
        .sentence = "Poisson's ratio: up to 0.45 of rigid elements, and up to 0.49 of deformable ones."},
    Key{.name = "deformable",
        .type = Type::boolean,
        .default_text = "false",
        .note = "needs youngs_modulus and poisson_ratio",
        .sentence =
            "Whether the elements strain and have a stress. False: they are rigid, and the joints between them are as elastic as "
            "the material."},
    Key{.name = "bulk_damping_ratio",
        .type = Type::number,
        .range = not_negative,
        .usual = usual::damping_ratio,
        .default_text = "0.0",
        .note = "only with deformable = true",
        .sentence = "Damping ratio of the strain of a deformable element: its stress grows with the rate of its strain."},
};

constexpr std::array leading_joint_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the joint in results and messages."},
    Key{.name = "between",
        .type = Type::two_names,
        .note = "exactly one of between and surface",
        .sentence = "The two materials (the same one twice for faces inside a material) whose shared faces it "
                    "joins."},
    Key{.name = "surface",
        .type = Type::text,
        .note = "exactly one of between and surface",
        .sentence = "Physical surface group inside the body whose faces it joins, such as a fault."},
    Key{.name = "bonded",
        .type = Type::boolean,
        .default_text = "true",
        .sentence = "False for faces that only touch, with the properties of [contact], such as a slit."},
    Key{.name = "law",
        .type = Type::choice,
        .default_text = "\"linear_softening\"",
        .sentence =
            "How a bonded joint fails. linear_softening: tension softens linearly until the joint breaks, and shear slips at "
            "the Mohr-Coulomb strength without end. mixed_mode: opening and slip use up one strength, each with its fracture "
            "energy, and friction remains. barton_bandis: a natural rock joint, which bears pressure and friction alone, closes "
            "under pressure, and dilates and wears as it slips.",
        .choices = laws::words_of_laws<laws::JointLaws>},
    Key{.name = "joint_normal_stiffness",
        .type = Type::number,
        .unit = "Pa/m",
        .range = positive,
        .usual = usual::stiffness_per_area,
        .note = without_moduli,
        .sentence = "Normal stiffness: normal stress per opening."},
    Key{.name = "joint_shear_stiffness",
        .type = Type::number,
        .unit = "Pa/m",
        .range = not_negative,
        .usual = usual::stiffness_per_area,
        .note = without_moduli,
        .sentence = "Shear stiffness: shear stress per elastic shear displacement."},
    Key{.name = "joint_normal_damping",
        .type = Type::number,
        .unit = "Pa s/m",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Normal dashpot: normal stress per opening velocity."},
    Key{.name = "joint_shear_damping",
        .type = Type::number,
        .unit = "Pa s/m",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Shear dashpot: shear stress per sliding velocity, beside the strength; of law barton_bandis within it."},
    Key{.name = "damping_ratio",
        .type = Type::number,
        .range = not_negative,
        .usual = usual::damping_ratio,
        .note = "instead of joint_normal_damping and joint_shear_damping",
        .sentence = "Damping ratio of the two elements beside each face, which move against each other on its springs."},
    Key{.name = "cohesion",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .usual = usual::strength,
        .note = when_bonded,
        .sentence = "Cohesion: shear strength at zero normal stress."},
    Key{.name = "friction_coefficient",
        .type = Type::number,
        .range = not_negative,
        .note = one_friction,
        .sentence = "Coefficient of friction: shear strength per compressive stress."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 90, .high_open = true},
        .usual = usual::friction_angle,
        .note = one_friction,
        .sentence = "Angle whose tangent is the friction coefficient."},
    Key{.name = "tensile_strength",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::strength,
        .note = when_bonded,
        .sentence = "Tensile strength: normal stress at which softening begins; at most sqrt(2 fracture_energy k) with the "
                    "normal stiffness k of each face."},
    Key{.name = "fracture_energy",
        .type = Type::number,
        .unit = "N/m",
        .range = positive,
        .usual = usual::fracture_energy,
        .note = when_bonded,
        .sentence = "Fracture energy: energy per area that the joint dissipates when it breaks in tension."},
    Key{.name = "weibull_modulus",
        .type = Type::number,
        .range = {.low = 1},
        .usual = usual::weibull_modulus,
        .note = "default: all faces have the same strength; not for law barton_bandis",
        .sentence =
            "Lets strengths and fracture energies scatter from face to face by Weibull's distribution with this modulus about "
            "those given here, which are the means."},
    Key{.name = "scatter_seed",
        .type = Type::integer,
        .range = {.low = 0, .high = 1e9},
        .default_text = "1",
        .note = "only with a weibull_modulus",
        .sentence = "Seed of the random strength factors of the faces."},
};

constexpr std::array rate_keys{
    Key{.name = "rate_law",
        .type = Type::choice,
        .default_text = "\"none\"",
        .note = "not for law barton_bandis",
        .sentence =
            "How tensile strength, cohesion and fracture energies grow with the rate of strain at which the joint is opened: "
            "not, as "
            "the fib Model Code 2010 or Malvar and Ross have it for concrete, or by a power or the logarithm of the rate.",
        .choices = laws::words_of_laws<laws::RateLaws>},
    Key{.name = "rate_energy_exponent",
        .type = Type::number,
        .range = {.low = 0, .high = 2},
        .default_text = "1.0",
        .note = "only with a rate_law",
        .sentence = "Power of the factor on the strength that fracture energies have: 0, they do not depend on the rate; 1, they "
                    "grow as the "
                    "strength; 2, the process zone of a crack keeps its length."},
};

constexpr auto joint_keys =
    joined(leading_joint_keys, keys_of_laws<laws::JointLaws>(), rate_keys, keys_of_laws<laws::RateLaws>());

constexpr std::array contact_keys{
    Key{.name = "contact_shape",
        .type = Type::choice,
        .default_text = "\"spheres\"",
        .sentence =
            "What touches: spheres behind the faces, which is fast, but bumpy where faces slide; or the true faces, which "
            "slide over each other as planes and keep the energy.",
        .choices = contact_shapes},
    Key{.name = "contact_stiffness",
        .type = Type::number,
        .unit = "N/m",
        .range = positive,
        .usual = usual::contact_stiffness,
        .note = "required for spheres; with faces for a coupled run alone, whose surface spheres touch",
        .sentence = "Normal stiffness of a pair of contact spheres: force per overlap."},
    Key{.name = "contact_damping",
        .type = Type::number,
        .unit = "N s/m",
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Normal dashpot of a pair: force per approach velocity; never attractive."},
    Key{.name = "face_contact_stiffness",
        .type = Type::number,
        .unit = "Pa/m",
        .range = positive,
        .usual = usual::stiffness_per_area,
        .note = "required with contact_shape = \"faces\"",
        .sentence = "Normal stiffness of two faces that touch: pressure per overlap."},
    Key{.name = "face_contact_damping",
        .type = Type::number,
        .unit = "Pa s/m",
        .range = not_negative,
        .default_text = "0.0",
        .note = "with contact_shape = \"faces\"",
        .sentence = "Normal dashpot of two faces that touch: pressure per approach velocity; never attractive."},
    Key{.name = "friction_coefficient",
        .type = Type::number,
        .range = not_negative,
        .note = "exactly one of friction_coefficient and friction_angle",
        .sentence = "Coefficient of friction: largest tangential force per normal force."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 90, .high_open = true},
        .usual = usual::friction_angle,
        .note = "exactly one of friction_coefficient and friction_angle",
        .sentence = "Angle whose tangent is the friction coefficient."},
    Key{.name = "damping_cap",
        .type = Type::choice,
        .default_text = "\"step\"",
        .sentence = "What limits a dashpot too stiff for the masses: literal: nothing; critical: critical damping; step: its "
                    "force is built up over several steps, as fast as their stability allows.",
        .choices = damping_caps},
    Key{.name = "edge_division",
        .type = Type::integer,
        .range = {.low = 3, .high = 20},
        .default_text = "5",
        .sentence = "Contact spheres sit at the interior points when each edge of a face is divided into this many "
                    "equal parts."},
};

constexpr std::array blast_keys{
    Key{.name = "name",
        .type = Type::text,
        .note = "default: the surface's name",
        .sentence = "Name of the hole in results and messages."},
    Key{.name = "surface", .type = Type::text, .need = Need::required, .sentence = "Physical surface group of the hole's wall."},
    Key{.name = "delay",
        .type = Type::number,
        .unit = "s",
        .range = not_negative,
        .usual = usual::delay,
        .default_text = "0.0",
        .sentence = "Time at which the pressure begins."},
    Key{.name = "peak_pressure",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::blast_pressure,
        .note = "required without table and function",
        .sentence = "Largest pressure P0 of the pulse."},
    Key{.name = "rise_time",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .usual = usual::rise_time,
        .note = "required without table and function",
        .sentence = "Rise time a: from zero to the largest pressure."},
    Key{.name = "decay_ratio",
        .type = Type::number,
        .range = positive,
        .note = "required without table and function",
        .sentence = "Time b from the largest pressure back to zero, divided by the rise time."},
    Key{.name = "table",
        .type = Type::file,
        .note = "instead of peak_pressure, rise_time and decay_ratio",
        .sentence = "CSV file with header \"time [s],pressure [Pa]\" and increasing times; linear between rows."},
    Key{.name = "function",
        .type = Type::boolean,
        .default_text = "false",
        .note = "instead of peak_pressure, rise_time and decay_ratio",
        .sentence = "The pressure is a function, given in Python, of the time since the delay."},
    Key{.name = "cut_distance",
        .type = Type::number,
        .unit = "m",
        .range = positive_or_infinite,
        .default_text = "inf",
        .sentence = "Displacement of a face at which its pressure ends for good; inf: never."},
};

constexpr std::array boundary_keys{
    Key{.name = "surface",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Physical surface group on the outside of the body."},
    Key{.name = "kind",
        .type = Type::choice,
        .need = Need::required,
        .sentence = "fixed: joined to immobile ground of the same material by springs and dashpots of its own joint; "
                    "frictionless: slides in the plane of each face; absorbing: dashpots that let waves leave and an incident "
                    "wave (E) enter; prescribed: like fixed, on ground that moves.",
        .choices = boundary_kinds},
    Key{.name = "motion_x",
        .type = Type::text,
        .note = with_motion,
        .sentence = "Motion of the ground, or of the incident wave, along x; along an axis without one the ground stands still."},
    Key{.name = "motion_y", .type = Type::text, .note = with_motion, .sentence = "Motion of the ground or the incident wave along y."},
    Key{.name = "motion_z", .type = Type::text, .note = with_motion, .sentence = "Motion of the ground or the incident wave along z."},
};

constexpr std::array constraint_keys{
    Key{.name = "regions",
        .type = Type::names,
        .need = Need::required,
        .sentence = "Physical volume groups whose elements are constrained."},
    Key{.name = "translation",
        .type = Type::axes,
        .default_text = "[]",
        .sentence = "Axes along which the elements cannot move."},
    Key{.name = "rotation", .type = Type::axes, .default_text = "[]", .sentence = "Axes about which the elements cannot turn."},
};

constexpr std::array initial_velocity_keys{
    Key{.name = "regions",
        .type = Type::names,
        .need = Need::required,
        .sentence = "Physical volume groups that have an initial velocity."},
    Key{.name = "velocity", .type = Type::vector, .unit = "m/s", .need = Need::required, .sentence = "Initial velocity."},
};

constexpr std::array gauge_keys{
    gauge_name_key,
    Key{.name = "point",
        .type = Type::vector,
        .unit = "m",
        .need = Need::required,
        .sentence = "Initial position: a point inside an element, with which it moves."},
};

constexpr std::array time_keys{
    end_key,
    Key{.name = "levels",
        .type = Type::choice,
        .default_text = "\"per_element\"",
        .sentence = "Whether every element has its own time level, or all have the finest that any element needs.",
        .choices = level_choices},
    Key{.name = "limiter",
        .type = Type::choice,
        .default_text = "\"stability\"",
        .sentence =
            "What limits the step of an element: its stability limit, its travel in a step, or nothing (base_step for all).",
        .choices = limiters},
    Key{.name = "base_step",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .note = "default: chosen from the stable steps; required for limiter travel and none",
        .sentence = "Largest time step; level k has the step base_step / 2^k."},
    Key{.name = "stability_fraction",
        .type = Type::number,
        .range = {.low = 0, .high = 1, .low_open = true},
        .default_text = "0.5",
        .sentence = "Ratio of the step of an element to the stability limit of its springs and dashpots with its neighbours "
                    "held; 0.5 allows for neighbours that move as well."},
    Key{.name = "travel_length",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .default_text = "10e-9",
        .sentence = "Largest travel of an element in a step (limiter travel)."},
    Key{.name = "neighbor_levels",
        .type = Type::integer,
        .range = {.low = 0, .high = 20},
        .default_text = "2",
        .sentence = "Largest difference of level between linked elements."},
    history_interval_key,
    snapshot_interval_key,
    Key{.name = "strict",
        .type = Type::boolean,
        .default_text = "false",
        .sentence = "Treat warnings as errors, such as that of a step above the stability limit."},
};

constexpr std::array tables{
    case_table,
    Table{"mesh", false, Need::required, "The body: tetrahedra with named volumes and surfaces.", mesh_keys},
    Table{"materials", true, Need::required, "Materials of the named volumes.", material_keys},
    Table{"joints", true, Need::required, "Joints between faces; where several entries match a face, the last one applies.",
          joint_keys},
    Table{"contact", false, Need::required, "Contact between free faces and between faces whose joint is broken.", contact_keys},
    Table{"blasts", true, Need::optional,
          "Pressure on the walls of holes: a pulse, a table from a CSV file, or a function given in Python.", blast_keys},
    Table{"charges", true, Need::optional,
          "Explosive in holes: the detonation runs along it, and its gas presses on the wall until it has expanded.",
          charge_keys},
    Table{"gravity", false, Need::optional, "Body force.", block_gravity_keys},
    face_water_table,
    Table{"initial_stress", false, Need::optional,
          "Stress in the body at the beginning, which bonded joints and boundaries carry.", initial_stress_keys},
    motions_table,
    Table{"boundaries", true, Need::optional, "Boundary conditions of outer faces; all others are free.", boundary_keys},
    Table{"constraints", true, Need::optional, "Axes along or about which whole volumes cannot move or turn.", constraint_keys},
    Table{"initial_velocities", true, Need::optional, "Initial velocities of volumes.", initial_velocity_keys},
    Table{"gauges", true, Need::optional, "Points whose velocity is recorded.", gauge_keys},
    Table{"time", false, Need::required, "Duration, time steps and intervals of output.", time_keys},
    output_table,
};

}  // namespace

std::span<const Table> blocks_schema() { return tables; }

}  // namespace sazare::cases
