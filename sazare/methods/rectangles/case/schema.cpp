#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/cases/format/usual_values.hpp"
#include "sazare/methods/rectangles/case/format.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 3> shapes{"rectangle", "polygon", "image"};
constexpr std::array<std::string_view, 3> element_shapes{"squares", "circles", "polygons"};
constexpr std::array<std::string_view, 2> layouts{"centres", "ends"};
constexpr std::array<std::string_view, 2> increments{"small", "exact"};

constexpr Range angle_range{.low = 0, .high = 90, .high_open = true};
constexpr std::string_view two_stiffnesses =
    "face_normal_stiffness and face_shear_stiffness, or youngs_modulus and poisson_ratio";

constexpr std::array element_keys{
    Key{.name = "thickness",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .default_text = "1.0",
        .sentence = "Out-of-plane thickness of all elements."},
};

constexpr std::array block_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the block in messages."},
    Key{.name = "material", .type = Type::text, .need = Need::required, .sentence = "Material of the block."},
    Key{.name = "shape",
        .type = Type::choice,
        .default_text = "\"rectangle\"",
        .sentence = "A rectangle, a polygon (filled with the squares whose centres lie inside; convex where elements are "
                    "polygons), or the dark pixels of an image.",
        .choices = shapes},
    Key{.name = "elements",
        .type = Type::choice,
        .default_text = "\"squares\"",
        .sentence = "Squares, the circles inscribed in them (with springs = 1 the usual circular elements), or the Voronoi "
                    "polygons of irregular nuclei, always with increments \"exact\".",
        .choices = element_shapes},
    Key{.name = "element_size",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .note = "required except for a rectangle, which is one element without it; not with nuclei",
        .sentence = "Side of the squares on the lattice; of an image, the side of a pixel; of polygons, the side of a square of "
                    "their mean "
                    "area."},
    Key{.name = "nuclei",
        .type = Type::file,
        .note = "polygons only; not with element_size",
        .sentence =
            "Nuclei of polygons, from a CSV file with the first line \"x [m],y [m]\", inside the block before it is turned."},
    Key{.name = "seed",
        .type = Type::integer,
        .range = {.low = 1, .high = 1000000},
        .default_text = "1",
        .sentence = "Seed of the irregular nuclei where no file gives them."},
    Key{.name = "lower",
        .type = Type::vector,
        .unit = "m",
        .note = "required for a rectangle and an image",
        .sentence = "Corner with the smallest coordinates before it is turned; z is 0."},
    Key{.name = "upper",
        .type = Type::vector,
        .unit = "m",
        .note = "required for a rectangle",
        .sentence = "Corner with the largest coordinates before it is turned; z is 0."},
    Key{.name = "points",
        .type = Type::points,
        .unit = "m",
        .note = "required for a polygon",
        .sentence = "Corners in order, first and last the same; the lattice starts at their smallest coordinates."},
    Key{.name = "file",
        .type = Type::file,
        .note = "required for an image",
        .sentence = "Grey-scale image (.pgm): white is empty, neighbouring pixels of one grey are joined, others only touch."},
    Key{.name = "angle",
        .type = Type::number,
        .unit = "deg",
        .default_text = "0.0",
        .sentence = "Rotation of the block about its lower corner, counter-clockwise."},
};

constexpr std::array material_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name by which blocks refer to it."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .usual = usual::density,
        .need = Need::required,
        .sentence = "Mass per volume."},
    Key{.name = "face_normal_stiffness",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::spring_modulus,
        .note = two_stiffnesses,
        .sentence = "k_n: normal stiffness: stress per strain between the centres of joined elements."},
    Key{.name = "face_shear_stiffness",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::spring_modulus,
        .note = two_stiffnesses,
        .sentence = "k_s: shear stiffness: stress per strain between the centres of joined elements."},
    Key{.name = "youngs_modulus",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::elastic_modulus,
        .note = two_stiffnesses,
        .sentence = "Young's modulus in plane strain, from which both stiffnesses follow: for squares by those of a square "
                    "lattice, for polygons by the mean over all directions."},
    Key{.name = "poisson_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 0.5, .high_open = true},
        .note = two_stiffnesses,
        .sentence = "Poisson's ratio; below 0.25 for polygons."},
    Key{.name = "damping_ratio",
        .type = Type::number,
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "h_n: damping ratio of two joined elements."},
    Key{.name = "tensile_strength",
        .type = Type::number,
        .unit = "Pa",
        .range = positive_or_infinite,
        .usual = usual::strength,
        .default_text = "inf",
        .sentence = "Tensile strength: normal stress at which a spring breaks for good."},
    Key{.name = "cohesion",
        .type = Type::number,
        .unit = "Pa",
        .range = {.low = 0, .infinite = true},
        .usual = usual::strength,
        .default_text = "inf",
        .sentence = "Cohesion: shear strength at zero normal stress, of springs that are not broken."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = angle_range,
        .usual = usual::friction_angle,
        .default_text = "0.0",
        .sentence = "Friction angle of the springs."},
    Key{.name = "springs",
        .type = Type::integer,
        .range = {.low = 1, .high = 1000},
        .default_text = "5",
        .sentence = "N: number of springs on each face; with 1 the elements rotate like circles."},
    Key{.name = "layout",
        .type = Type::choice,
        .default_text = "\"centres\"",
        .sentence = "Position of the springs: at the centres of N equal parts of the face, or (N = 2) at its two ends.",
        .choices = layouts},
    Key{.name = "increments",
        .type = Type::choice,
        .default_text = "\"small\"",
        .sentence = "Formula for the displacements of the springs: (15) for small relative rotations, or (3) for any.",
        .choices = increments},
};

constexpr std::array contact_keys{
    Key{.name = "face_normal_stiffness",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::spring_modulus,
        .need = Need::required,
        .sentence = "k_n in contact: between elements that are not joined, and between elements and supports."},
    Key{.name = "face_shear_stiffness",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::spring_modulus,
        .need = Need::required,
        .sentence = "k_s in contact."},
    Key{.name = "damping_ratio",
        .type = Type::number,
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "h_n in contact: damping ratio; the normal force is never attractive."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = angle_range,
        .usual = usual::friction_angle,
        .need = Need::required,
        .sentence = "Friction angle of contacts."},
};

constexpr Key velocity_key{
    .name = "velocity", .type = Type::vector, .unit = "m/s", .default_text = "[0.0, 0.0, 0.0]", .sentence = "Constant velocity."};
constexpr Key motion_x_key{.name = "motion_x", .type = Type::text, .note = "not with a velocity", .sentence = "Motion along x."};
constexpr Key motion_y_key{.name = "motion_y", .type = Type::text, .note = "not with a velocity", .sentence = "Motion along y."};

constexpr std::array wall_keys{
    Key{.name = "name",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Name of the wall; its columns in history.csv begin with it."},
    Key{.name = "from",
        .type = Type::vector,
        .unit = "m",
        .need = Need::required,
        .sentence = "Start point; seen towards the end point, the free side is on the left and the solid one on the right."},
    Key{.name = "to", .type = Type::vector, .unit = "m", .need = Need::required, .sentence = "End point; z is 0."},
    velocity_key,
    motion_x_key,
    motion_y_key,
};

constexpr std::array roller_keys{
    Key{.name = "name",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Name of the roller; its columns in history.csv begin with it."},
    Key{.name = "center", .type = Type::vector, .unit = "m", .need = Need::required, .sentence = "Centre; z is 0."},
    Key{.name = "radius",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .need = Need::required,
        .sentence = "Radius; the roller does not turn."},
    velocity_key,
    motion_x_key,
    motion_y_key,
};

constexpr std::array plate_keys{
    Key{.name = "friction_coefficient",
        .type = Type::number,
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Coefficient of friction between all elements and the plate on which they lie; 0: no friction."},
    Key{.name = "velocity",
        .type = Type::vector,
        .unit = "m/s",
        .default_text = "[0.0, 0.0, 0.0]",
        .sentence = "Velocity with which the plate is pulled beneath them."},
    Key{.name = "gravity",
        .type = Type::number,
        .unit = "m/s2",
        .range = positive,
        .default_text = "9.81",
        .sentence = "Gravitational acceleration normal to the plane, which presses the elements on the plate."},
};

constexpr std::array gauge_keys{
    gauge_name_key,
    Key{.name = "point",
        .type = Type::vector,
        .unit = "m",
        .need = Need::required,
        .sentence = "Initial position: the gauge records the motion of the element that contains it."},
};

constexpr std::array time_keys{
    end_key,
    Key{.name = "step",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .note = "default: stability_fraction of the predicted stability limit, or a little less",
        .sentence = "Time step of all elements; above the predicted stability limit the case is refused."},
    Key{.name = "stability_fraction",
        .type = Type::number,
        .range = stability_fraction_range,
        .default_text = "0.8",
        .sentence = "Ratio of the step to the predicted stability limit where no step is given."},
    history_interval_key,
    snapshot_interval_key,
    strict_key,
};

constexpr std::array tables{
    case_table,
    Table{"elements", false, Need::optional, "Thickness of all elements.", element_keys},
    Table{"blocks", true, Need::required, "Bodies: squares joined on a lattice, polygons, or one rectangle.", block_keys},
    Table{"materials", true, Need::required, "Materials of the blocks.", material_keys},
    Table{"contact", false, Need::required, "Springs, dashpots and friction between elements that touch without being joined.",
          contact_keys},
    Table{"walls", true, Need::optional, "Straight supports.", wall_keys},
    Table{"rollers", true, Need::optional, "Circular supports and platens.", roller_keys},
    motions_table,
    Table{"base_friction", false, Need::optional,
          "Base-friction model of a slope: a plate beneath the elements that drags them by friction.", plate_keys},
    gravity_table,
    Table{"gauges", true, Need::optional, "Elements whose motion is recorded.", gauge_keys},
    Table{"time", false, Need::required, "Duration, time step and intervals of output.", time_keys},
    output_table,
};

}  // namespace

std::span<const Table> rectangles_schema() { return tables; }

}  // namespace sazare::cases
