#include "sazare/methods/rectangles/run/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/motion_of_case.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/machine_memory.hpp"
#include "sazare/geometry/plane/voronoi.hpp"
#include "sazare/methods/rectangles/case/case.hpp"
#include "sazare/methods/rectangles/case/nuclei_file.hpp"
#include "sazare/methods/rectangles/packing.hpp"
#include "sazare/methods/rectangles/run/grey_image.hpp"

namespace sazare::runs {

namespace {

using cases::BlockShape;
using geometry::OutlineKind;
using geometry::Vector2;
using methods::rectangles::FaceKind;
constexpr Real overlap_tolerance = 1e-6;  // of an element
constexpr Real near_support = 0.05;       // of an element

Real radians(Real degrees) { return degrees * std::numbers::pi / 180; }

constexpr int bytes_of_element = 500;  // at least, with its links

/// Squares of a lattice by column and row; what they are joined by must be equal.
using Lattice = std::map<std::pair<int, int>, int>;

/// Crossings of the ray to the right are counted.
bool holds(const std::vector<std::array<Real, 2>>& points, Real x, Real y) {
  bool inside = false;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto &a = points[i], &b = points[i + 1];
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

class Assembler {
public:
  explicit Assembler(const cases::CaseFile& file) : file_(file), case_(file.as<cases::RectanglesCase>()) {}

  Assembly assemble() {
    for (const cases::SquareMaterial& material : case_.materials) densities_.push_back(material.density);
    for (std::size_t i = 0; i < case_.blocks.size(); ++i) {
      add_block(i);
      result_.case_block.resize(static_cast<std::size_t>(blocks_), static_cast<Index>(i));
    }
    result_.elements = static_cast<Index>(places_.size());
    for (const cases::Wall& wall : case_.walls) add_wall(wall);
    for (const cases::Roller& roller : case_.rollers) add_roller(roller);
    make_particles();
    add_loads();
    return std::move(result_);
  }

private:
  struct Place {
    Vector2 centre;
    Real angle = 0;
    Real density = 0;
  };

  Index material_of(const cases::SquareBlock& block) const {
    return static_cast<Index>(std::ranges::find(case_.materials, block.material, &cases::SquareMaterial::name) -
                              case_.materials.begin());
  }

  void add_block(std::size_t number) {
    const cases::SquareBlock& block = case_.blocks[number];
    if (block.elements == cases::ElementShape::polygons) return add_packing(number, block);
    if (block.shape == BlockShape::rectangle && !(block.element_size > 0)) return add_single(block);
    const auto [corner, lattice] = lattice_of(number, block);
    if (lattice.empty())
      refuse(file_, fmt::format("blocks.{}", number), fmt::format("the block \"{}\" contains no element", block.name),
             "choose a smaller element_size");
    const Real angle = radians(block.angle), half = 0.5 * block.element_size;
    const Vector2 axis(std::cos(angle), std::sin(angle)), other(-axis.y(), axis.x());
    const OutlineKind outline = block.elements == cases::ElementShape::circles ? OutlineKind::circle : OutlineKind::rectangle;
    const Index kind = kind_of(material_of(block), outline, half);
    std::map<std::pair<int, int>, Index> element;
    std::map<int, Index> part;  // the blocks of an image, by grey
    for (const auto& [site, grey] : lattice) {
      const Index own = part.try_emplace(grey, blocks_ + static_cast<Index>(part.size())).first->second;
      const Vector2 place = corner + half * ((2 * site.second + 1) * axis + (2 * site.first + 1) * other);
      element[site] =
          add_element(outline, half, half, own, {place, angle, densities_[static_cast<std::size_t>(material_of(block))]});
    }
    blocks_ += static_cast<Index>(part.size());
    for (const auto& [site, own] : element)
      for (const int along : {0, 1}) {
        const auto next = element.find({site.first + along, site.second + 1 - along});
        if (next != element.end() && lattice.at(next->first) == lattice.at(site))
          result_.parts.links.push_back({own, next->second, along, kind, 0});
      }
  }

  /// Polygons around nuclei, which a file gives or chance.
  void add_packing(std::size_t number, const cases::SquareBlock& block) {
    const std::vector<Vector2> outline = cases::outline_of(block);
    const Index material = material_of(block);
    const Real density = densities_[static_cast<std::size_t>(material)];
    const auto packing =
        methods::rectangles::pack(nuclei_of(number, block, outline), outline, density * case_.elements.thickness);
    Vector2 corner = outline.front();
    for (const Vector2& point : outline) corner = corner.cwiseMin(point);
    const Real angle = radians(block.angle);
    const Vector2 axis(std::cos(angle), std::sin(angle)), other(-axis.y(), axis.x());
    const auto begin = static_cast<Index>(places_.size());
    for (std::size_t i = 0; i < packing.centres.size(); ++i) {
      if (packing.corners[i].size() > geometry::most_faces)
        refuse(file_, fmt::format("blocks.{}.nuclei", number),
               fmt::format("a nucleus of the block \"{}\" has {} neighbours, more than {}", block.name, packing.corners[i].size(),
                           geometry::most_faces),
               "distribute the nuclei more evenly");
      const Vector2 way = packing.centres[i] - corner;
      result_.parts.outlines.add_polygon(packing.corners[i], packing.outside[i], blocks_);
      places_.push_back({corner + way.x() * axis + way.y() * other, angle, density});
    }
    ++blocks_;
    const Index kind = kind_of(material, OutlineKind::polygon, 0);
    for (methods::rectangles::FacetLink facet : packing.facets) {
      facet.first += begin;
      facet.second += begin;
      facet.kind = kind;
      result_.parts.facets.push_back(facet);
    }
  }

  std::vector<Vector2> nuclei_of(std::size_t number, const cases::SquareBlock& block, const std::vector<Vector2>& outline) const {
    if (block.nuclei.empty()) {
      check_count(number, geometry::measure(outline).area / block.element_size / block.element_size);
      return geometry::scatter_nuclei(outline, block.element_size, block.seed);
    }
    std::vector<Vector2> nuclei;
    for (const auto& place : block.places) nuclei.emplace_back(place[0], place[1]);
    geometry::sort_along_curve(nuclei, std::sqrt(geometry::measure(outline).area / static_cast<Real>(nuclei.size())));
    return nuclei;
  }

  void add_single(const cases::SquareBlock& block) {
    const Vector2 size = (block.upper - block.lower).head<2>();
    const Real angle = radians(block.angle);
    const Vector2 axis(std::cos(angle), std::sin(angle)), other(-axis.y(), axis.x());
    add_element(OutlineKind::rectangle, 0.5 * size.x(), 0.5 * size.y(), blocks_++,
                {block.lower.head<2>() + 0.5 * (size.x() * axis + size.y() * other), angle,
                 densities_[static_cast<std::size_t>(material_of(block))]});
  }

  void check_count(std::size_t number, Real elements) const {
    const Real memory = machine_memory();
    if (bytes_of_element * elements <= memory) return;
    refuse(file_, fmt::format("blocks.{}.element_size", number),
           fmt::format("the block would have {} elements", cases::short_number(elements, 3)),
           fmt::format("they need {} bytes each or more, and this machine has {} GB of memory: choose larger ones",
                       bytes_of_element, cases::short_number(1e-9 * memory, 3)));
  }

  /// Lower corner and sites (row, column).
  std::pair<Vector2, Lattice> lattice_of(std::size_t number, const cases::SquareBlock& block) const {
    Lattice lattice;
    const Real size = block.element_size;
    const auto real_count = [&](Real length) { return std::ceil(length / size - 1e-6); };
    const auto count = [&](Real length) { return static_cast<int>(real_count(length)); };
    if (block.shape == BlockShape::image) {
      const GreyImage image = image_of(number, block);
      for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column)
          if (const int grey = image.at(column, image.height - 1 - row); grey < image.white) lattice[{row, column}] = grey;
      return {block.lower.head<2>(), lattice};
    }
    Vector2 lower = block.lower.head<2>(), upper = block.upper.head<2>();
    if (block.shape == BlockShape::polygon) {
      lower = upper = {block.points.front()[0], block.points.front()[1]};
      for (const auto& point : block.points) {
        lower = lower.cwiseMin(Vector2(point[0], point[1]));
        upper = upper.cwiseMax(Vector2(point[0], point[1]));
      }
    }
    check_count(number, real_count(upper.x() - lower.x()) * real_count(upper.y() - lower.y()));
    for (int row = 0; row < count(upper.y() - lower.y()); ++row)
      for (int column = 0; column < count(upper.x() - lower.x()); ++column)
        if (block.shape == BlockShape::rectangle ||
            holds(block.points, lower.x() + (column + 0.5) * size, lower.y() + (row + 0.5) * size))
          lattice[{row, column}] = 0;
    return {lower, lattice};
  }

  GreyImage image_of(std::size_t number, const cases::SquareBlock& block) const {
    try {
      return read_grey_image(block.file);
    } catch (const UserError& error) {
      refuse(file_, fmt::format("blocks.{}.file", number), error.what(), "give a grey-scale image in PGM format");
    }
  }

  /// The springs of a material's faces of this half length; (6.3), (6.4), (7.3), (7.4), (8), (11). Of polygons those of the facet
  /// that FacetLink refers to.
  Index kind_of(Index material, OutlineKind outline, Real half) {
    const auto [found, is_new] = kinds_.try_emplace({material, outline, half}, static_cast<Index>(result_.parts.kinds.size()));
    if (!is_new) return found->second;
    const cases::SquareMaterial& of = case_.materials[static_cast<std::size_t>(material)];
    const bool polygon = outline == OutlineKind::polygon;
    FaceKind kind;
    kind.formula =
        of.increments == cases::IncrementFormula::small && !polygon ? laws::FaceFormula::small : laws::FaceFormula::exact;
    laws::FaceSprings& springs = kind.springs;
    springs.places = laws::spring_places(static_cast<laws::SpringPlaces>(of.layout), of.springs);
    const Real half_face = polygon ? 1 : half, distance = polygon ? 1 : 2 * half;
    const Real count = springs.count(), area = 2 * half_face * case_.elements.thickness;
    const Real mass = (outline == OutlineKind::circle ? std::numbers::pi / 4 : 1) * distance * area * of.density;
    springs.first_reach = springs.second_reach = springs.half_face = half_face;
    springs.normal = of.normal_stiffness * area / (distance * count);
    springs.shear = of.shear_stiffness * area / (distance * count);
    springs.normal_damping = 2 * of.damping_ratio * std::sqrt(springs.normal * count * (polygon ? 1 : mass / 2)) / count;
    springs.shear_damping = springs.normal_damping * std::sqrt(springs.shear / springs.normal);
    springs.tension_limit = of.tensile_strength * area / count;
    springs.cohesion_limit = of.cohesion * area / count;
    springs.friction = std::tan(radians(of.friction_angle));
    result_.parts.kinds.push_back(kind);
    return found->second;
  }

  Index add_element(OutlineKind kind, Real half_width, Real half_height, Index block, const Place& place) {
    result_.parts.outlines.add(kind, half_width, half_height, block);
    places_.push_back(place);
    return static_cast<Index>(places_.size()) - 1;
  }

  void add_wall(const cases::Wall& wall) {
    const Vector2 way = (wall.to - wall.from).head<2>();
    add_support(OutlineKind::wall, 0.5 * way.norm(), 0, {0.5 * (wall.from + wall.to).head<2>(), std::atan2(way.y(), way.x())},
                wall.moves);
  }

  void add_roller(const cases::Roller& roller) {
    add_support(OutlineKind::circle, roller.radius, roller.radius, {roller.center.head<2>()}, roller.moves);
  }

  void add_support(OutlineKind kind, Real half_width, Real half_height, const Place& place, const cases::SupportMotion& moves) {
    const Index own = add_element(kind, half_width, half_height, -1, place);
    ++result_.parts.supports;
    result_.supports.held.push_back({own, 2});
    for (int axis = 0; axis < 2; ++axis) {
      auto& motions = result_.supports.motions;
      if (const auto motion = cases::motion_named(case_.motions, moves.motion[static_cast<std::size_t>(axis)]))
        motions.push_back(*motion);
      else if (moves.velocity[axis] != 0)
        motions.push_back(cases::constant_velocity(moves.velocity[axis], case_.time.end));
      else {
        result_.supports.held.push_back({own, axis});
        continue;
      }
      result_.supports.driven.push_back({own, axis, static_cast<Index>(motions.size()) - 1, 1});
    }
  }

  void make_particles() {
    state::Particles<2>& particles = result_.particles;
    const state::Outlines& outlines = result_.parts.outlines;
    particles.resize(static_cast<Index>(places_.size()));
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Place& place = places_[i];
      particles.start[0][i] = place.centre.x();
      particles.start[1][i] = place.centre.y();
      particles.angle[i] = place.angle;
      particles.rotation[0][i] = std::cos(place.angle);
      particles.rotation[1][i] = std::sin(place.angle);
      const Real mass = outlines.mass(i, place.density, case_.elements.thickness);
      const bool moves_freely = outlines.block[i] >= 0;
      particles.inverse_mass[i] = moves_freely ? 1 / mass : 0;
      particles.inverse_inertia[i] = moves_freely ? 1 / (mass * outlines.gyration_square(i)) : 0;
    }
  }

  void add_loads() {
    for (int axis = 0; axis < 2; ++axis) result_.supports.gravity[axis] = case_.gravity.acceleration[axis];
    result_.parts.contact = {case_.contact.normal_stiffness, case_.contact.shear_stiffness, case_.contact.damping_ratio,
                             std::tan(radians(case_.contact.friction_angle)), case_.elements.thickness};
    result_.parts.base_friction = {case_.plate.friction_coefficient, case_.plate.velocity.head<2>(), case_.plate.gravity};
  }

  const cases::CaseFile& file_;
  const cases::RectanglesCase& case_;
  Assembly result_;
  std::vector<Place> places_;
  std::vector<Real> densities_;
  std::map<std::tuple<Index, OutlineKind, Real>, Index> kinds_;
  Index blocks_ = 0;
};

/// Looks at the beginning for what overlaps, and for supports that hold nothing.
class BeginningCheck {
public:
  BeginningCheck(const cases::CaseFile& file, const Assembly& assembly)
      : file_(file), case_(file.as<cases::RectanglesCase>()), assembly_(assembly) {}

  void check() const {
    methods::rectangles::RectangleForces forces(assembly_.particles, assembly_.parts, 1);
    state::FreedomColumns<2> ignored;
    for (auto& column : ignored) column.resize(assembly_.particles.padded());
    forces.evaluate(assembly_.particles, ignored);
    std::vector<bool> holds_something(assembly_.parts.outlines.size(), false);
    for (const methods::rectangles::Contact& pair : forces.contacts().pairs()) {
      check(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
      holds_something[static_cast<std::size_t>(pair.second)] =
          holds_something[static_cast<std::size_t>(pair.second)] || is_near(pair);
    }
    for (std::size_t i = 0; i < case_.rollers.size(); ++i) {
      const cases::Roller& roller = case_.rollers[i];
      const bool still = roller.moves.velocity.isZero() && roller.moves.motion[0].empty() && roller.moves.motion[1].empty();
      if (still && !holds_something[first_roller() + i])
        refuse(file_, fmt::format("rollers.{}.center", i), fmt::format("the support \"{}\" touches no element", roller.name),
               "move it to the block, or give it a velocity");
    }
  }

private:
  std::size_t first_roller() const { return static_cast<std::size_t>(assembly_.elements) + case_.walls.size(); }

  /// A roller a little larger would touch.
  bool is_near(const methods::rectangles::Contact& pair) const {
    const auto& outlines = assembly_.parts.outlines;
    geometry::Outline roller = outlines.at(assembly_.particles, static_cast<std::size_t>(pair.second));
    roller.half_width += near_support * outlines.spring_radius(static_cast<std::size_t>(pair.first));
    return geometry::overlap(outlines.at(assembly_.particles, static_cast<std::size_t>(pair.first)), roller).count > 0;
  }

  void check(std::size_t first, std::size_t second) const {
    const auto& outlines = assembly_.parts.outlines;
    if (outlines.block[first] == outlines.block[second]) return;
    const geometry::Overlap found =
        geometry::overlap(outlines.at(assembly_.particles, first), outlines.at(assembly_.particles, second));
    Real depth = 0;
    for (int i = 0; i < found.count; ++i) depth = std::max(depth, found.points[static_cast<std::size_t>(i)].depth);
    if (depth <= overlap_tolerance * outlines.spring_radius(first)) return;
    refuse(file_, key_of(second),
           fmt::format("an element of the block at ({}, {}) m overlaps another element by {} m",
                       cases::short_number(assembly_.particles.start[0][first], 4),
                       cases::short_number(assembly_.particles.start[1][first], 4), cases::short_number(depth, 3)),
           "bodies may touch at the start, but not overlap: move one of them");
  }

  std::string key_of(std::size_t outline) const {
    if (outline >= first_roller()) return fmt::format("rollers.{}", outline - first_roller());
    if (outline >= static_cast<std::size_t>(assembly_.elements))
      return fmt::format("walls.{}", outline - static_cast<std::size_t>(assembly_.elements));
    return fmt::format("blocks.{}", assembly_.case_block[static_cast<std::size_t>(assembly_.parts.outlines.block[outline])]);
  }

  const cases::CaseFile& file_;
  const cases::RectanglesCase& case_;
  const Assembly& assembly_;
};

}  // namespace

Assembly assemble(const cases::CaseFile& file) {
  Assembly assembly = Assembler(file).assemble();
  BeginningCheck(file, assembly).check();
  return assembly;
}

}  // namespace sazare::runs
