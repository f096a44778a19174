#include "sazare/methods/spheres/run/placing/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/random.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/run/placing/bodies_file.hpp"
#include "sazare/methods/spheres/run/placing/clump_shape.hpp"
#include "sazare/methods/spheres/run/placing/file.hpp"
#include "sazare/methods/spheres/run/placing/lattice.hpp"
#include "sazare/methods/spheres/run/placing/lowering.hpp"
#include "sazare/neighbors/sphere_grid.hpp"
#include "sazare/neighbors/sphere_pairs.hpp"

namespace sazare::runs {

namespace {

using cases::short_number;
using cases::SphereGroup;
using cases::SphereSource;
using geometry::Ball;

constexpr int most_tries = 2000;  // for a place of a random sphere
constexpr std::size_t most_listed = 4;

class Placer {
public:
  explicit Placer(const cases::CaseFile& file) : file_(file), spheres_(file.as<cases::SpheresCase>()) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!spheres_.domain.periodic[static_cast<std::size_t>(axis)]) continue;
      result_.spheres.box.lower[axis] = spheres_.domain.lower[axis];
      result_.spheres.box.length[axis] = spheres_.domain.upper[axis] - spheres_.domain.lower[axis];
    }
  }

  Placement place() {
    for (std::size_t i = 0; i < spheres_.spheres.size(); ++i) add(i);
    check_sizes();
    find_bonded();
    check_overlaps();
    return std::move(result_);
  }

private:
  void add(std::size_t number) {
    const SphereGroup& group = spheres_.spheres[number];
    if (!group.shape.empty()) return add_bodies(number);
    if (group.source == SphereSource::bodies) return add_bodies_of_file(number);
    std::vector<Ball> balls;
    if (group.source == SphereSource::one) balls = {{group.centre, group.radius}};
    check_count(file_, number, group, 1);
    if (group.source == SphereSource::file)
      for (const FileBall& row : read_balls(group.file)) balls.push_back(row.ball);
    if (group.source == SphereSource::lattice) balls = lattice(group);
    if (group.source == SphereSource::random) balls = scatter(number, group);
    if (balls.empty()) refuse_empty(number);
    const Index material = material_of(group);
    Random random(group.seed);
    if (group.lowered) {
      Lowering lowering(spheres_, result_.spheres);
      for (Ball& ball : balls) lower(number, lowering, std::span(&ball, 1));
    }
    for (const Ball& ball : balls) {
      result_.spheres.add(ball.centre, ball.radius, density_of(material), material, group.held);
      result_.group.push_back(static_cast<Index>(number));
      result_.body.push_back(-1);
      result_.bonded_body.push_back(-1);
      result_.spheres.set_motion(result_.spheres.size() - 1, group.held ? group.velocity : velocity_of(group, random),
                                 group.spin);
    }
  }

  [[noreturn]] void refuse_empty(std::size_t number) const {
    const SphereGroup& group = spheres_.spheres[number];
    refuse(file_, fmt::format("spheres.{}", number), fmt::format("the group \"{}\" has no sphere", group.name),
           group.source == SphereSource::file ? "the file holds no row of numbers" : "its box is too small for the radius");
  }

  void note_shape(const std::string& name, const Shape& shape) {
    if (std::ranges::find(result_.shapes, name, &ShapeVolume::shape) == result_.shapes.end())
      result_.shapes.push_back({name, shape.volume, shape.fill});
  }

  /// Lowers the balls of one body; how far.
  Vector3 lower(std::size_t number, Lowering& lowering, std::span<Ball> balls) const {
    const auto way = lowering.way_down(balls);
    if (!way)
      refuse(
          file_, fmt::format("spheres.{}.lowered", number),
          fmt::format("there is nothing below ({}, {}, {}) on which \"{}\" could stand", short_number(balls[0].centre.x(), 4),
                      short_number(balls[0].centre.y(), 4), short_number(balls[0].centre.z(), 4), spheres_.spheres[number].name),
          "a plane, or spheres of a group before, have to lie below every place");
    for (Ball& ball : balls) {
      ball.centre += *way * lowering.down();
      lowering.add(ball);
    }
    return *way * lowering.down();
  }

  Index material_of(const SphereGroup& group) const {
    return static_cast<Index>(std::ranges::find(spheres_.materials, group.material, &cases::SphereMaterial::name) -
                              spheres_.materials.begin());
  }
  Real density_of(Index material) const { return spheres_.materials[static_cast<std::size_t>(material)].density; }

  static Vector3 velocity_of(const SphereGroup& group, Random& random) {
    Vector3 velocity = group.velocity;
    if (group.noise > 0)
      for (Real& part : velocity) part += random.between(-group.noise, group.noise);
    return velocity;
  }

  static Eigen::Quaternion<Real> rotation_of(const Vector3& rotation) {
    const Real angle = rotation.norm();
    return Eigen::Quaternion<Real>(
        Eigen::AngleAxis<Real>(angle, angle > 0 ? Vector3(rotation / angle) : Vector3(Vector3::UnitX())));
  }

  /// Any rotation, none more likely than another (Shoemake).
  static Eigen::Quaternion<Real> random_rotation(Random& random) {
    constexpr Real turn = 2 * std::numbers::pi;
    const Real share = random.between(0, 1), one = random.between(0, turn), other = random.between(0, turn);
    return {std::sqrt(share) * std::cos(other), std::sqrt(1 - share) * std::sin(one), std::sqrt(1 - share) * std::cos(one),
            std::sqrt(share) * std::sin(other)};
  }

  /// Bodies of a shape; a place is found for the sphere around each.
  void add_bodies(std::size_t number) {
    SphereGroup group = spheres_.spheres[number];
    const auto found = std::ranges::find(spheres_.shapes, group.shape, &cases::ClumpShape::name);
    const Shape shape = make_shape(file_, static_cast<std::size_t>(found - spheres_.shapes.begin()));
    group.radius = shape.reach;
    group.largest_radius.reset();
    check_domain(shape, group.shape);
    check_count(file_, number, group, shape.balls.size());
    note_shape(group.shape, shape);
    if (!shape.shares.empty()) result_.share_error = std::max(result_.share_error, shape.share_error);
    std::vector<Ball> places;
    std::vector<Vector3> rotations;
    if (group.source == SphereSource::one) places = {{group.centre, shape.reach}};
    if (group.source == SphereSource::lattice) places = lattice(group);
    if (group.source == SphereSource::random) places = scatter(number, group);
    if (group.source == SphereSource::file)
      for (const auto& [line, row] : read_rows(group.file, place_rows)) {
        places.push_back({{row[0], row[1], row[2]}, shape.reach});
        rotations.emplace_back(row[3], row[4], row[5]);
      }
    if (places.empty()) refuse_empty(number);
    Random random(group.seed);
    std::optional<Lowering> lowering;
    if (group.lowered) lowering.emplace(spheres_, result_.spheres);
    for (std::size_t n = 0; n < places.size(); ++n) {
      const auto rotation =
          group.random_rotation ? random_rotation(random) : rotation_of(rotations.empty() ? group.rotation : rotations[n]);
      if (lowering) {
        std::vector<Ball> balls = balls_of(shape, places[n].centre, rotation);
        places[n].centre += lower(number, *lowering, balls);
      }
      const Vector3 velocity = velocity_of(group, random);
      shape.shares.empty() ? add_body(number, shape, {places[n].centre, rotation, velocity, group.spin})
                           : add_bonded_body(number, shape, places[n].centre, rotation, velocity);
    }
  }

  /// Rigid bodies, each with its own spheres and motion.
  void add_bodies_of_file(std::size_t number) {
    const SphereGroup& group = spheres_.spheres[number];
    const std::vector<FileBody> bodies = read_bodies(group.bodies_file, group.file);
    if (bodies.empty()) refuse_empty(number);
    std::size_t count = 0;
    for (const FileBody& body : bodies) count += body.balls.size();
    check_count(file_, number, group, count);
    for (const FileBody& body : bodies) {
      Shape shape;
      shape.balls = body.balls;
      shape.volume = body.volume;
      shape = along_principal_axes(std::move(shape), body.centre, body.inertia);
      check_domain(shape, group.name);
      add_body(number, shape, {body.centre, Eigen::Quaternion<Real>::Identity(), body.velocity, body.spin});
    }
  }

  static std::vector<Ball> balls_of(const Shape& shape, const Vector3& centre, const Eigen::Quaternion<Real>& rotation) {
    std::vector<Ball> balls = shape.balls;
    for (Ball& ball : balls) ball.centre = centre + rotation * (shape.axes * ball.centre);
    return balls;
  }

  struct Start {
    Vector3 centre;
    Eigen::Quaternion<Real> rotation;
    Vector3 velocity, spin;
  };

  void add_body(std::size_t number, const Shape& shape, const Start& start) {
    const SphereGroup& group = spheres_.spheres[number];
    const Index material = material_of(group);
    const Real density = density_of(material);
    const Eigen::Quaternion<Real> turn = start.rotation * Eigen::Quaternion<Real>(shape.axes);
    state::Clump clump;
    clump.centre = start.centre;
    clump.velocity = start.velocity;
    clump.turn = {turn.w(), turn.x(), turn.y(), turn.z()};
    clump.mass = density * shape.volume;
    clump.inertia = density * shape.inertia;
    clump.volume = shape.volume;
    clump.first_member = static_cast<std::int64_t>(result_.clumps.members.size());
    const Vector3 own = (turn.conjugate() * start.spin).cwiseProduct(density * shape.inertia);
    clump.angular_momentum = turn * own;
    for (const Ball& ball : shape.balls) {
      result_.clumps.members.push_back({static_cast<Index>(result_.spheres.size()), 0, ball.centre});
      result_.spheres.add(start.centre + turn * ball.centre, ball.radius, density, material, true);
      result_.spheres.place.back().mass = clump.mass;
      result_.group.push_back(static_cast<Index>(number));
      result_.body.push_back(static_cast<Index>(result_.clumps.clumps.size()));
      result_.bonded_body.push_back(-1);
    }
    result_.clumps.clumps.push_back(clump);
  }

  /// Single spheres with their shares of the mass, and bonds between neighbours.
  void add_bonded_body(std::size_t number, const Shape& shape, const Vector3& centre, const Eigen::Quaternion<Real>& rotation,
                       const Vector3& velocity) {
    const SphereGroup& group = spheres_.spheres[number];
    const Index material = material_of(group);
    const Real density = density_of(material);
    const auto first = static_cast<Index>(result_.spheres.size());
    const std::vector<Ball> balls = balls_of(shape, centre, rotation);
    for (std::size_t n = 0; n < balls.size(); ++n) {
      const std::size_t sphere = result_.spheres.size();
      result_.spheres.add(balls[n].centre, balls[n].radius, density, material);
      result_.spheres.set_share(sphere, density * shape.shares[n].volume, density * shape.shares[n].inertia);
      result_.spheres.set_motion(sphere, velocity + group.spin.cross(balls[n].centre - centre), group.spin);
      result_.group.push_back(static_cast<Index>(number));
      result_.body.push_back(-1);
      result_.bonded_body.push_back(result_.bonded_bodies);
    }
    for (const auto& [one, other] : shape.neighbours) result_.bonded.push_back({first + one, first + other, shape.bonds});
    ++result_.bonded_bodies;
  }

  /// Random places are those of whole spheres within the box of their group.
  void check_box(std::size_t number, const SphereGroup& group) const {
    const Real width = 2 * group.largest_radius.value_or(group.radius);
    for (int axis = 0; axis < 3; ++axis) {
      const Real length = group.upper[axis] - group.lower[axis];
      if (repeats(axis, group) || length >= width) continue;
      refuse(file_, fmt::format("spheres.{}.upper", number),
             fmt::format("the box of the group \"{}\" is {} m along {}, and its largest {} {} m wide", group.name,
                         short_number(length, 4), "xyz"[axis], group.shape.empty() ? "sphere" : "body", short_number(width, 4)),
             "random places are such that all lies within the box: make it larger");
    }
  }

  /// Random places without overlap, one after the other, the largest first.
  std::vector<Ball> scatter(std::size_t number, const SphereGroup& group) {
    check_box(number, group);
    Random random(group.seed);
    std::vector<Ball> balls(static_cast<std::size_t>(group.count));
    for (Ball& ball : balls) ball.radius = random.between(group.radius, group.largest_radius.value_or(group.radius));
    std::ranges::stable_sort(balls, std::ranges::greater{}, &Ball::radius);
    neighbors::SphereGrid grid;
    std::vector<Ball> all;
    for (const auto& place : result_.spheres.place) all.push_back({result_.spheres.box.wrapped(place.centre()), place.radius});
    for (std::size_t i = 0; i < all.size(); ++i) grid.place(static_cast<Index>(i), all[i].centre, all[i].radius);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      int tries = 0;
      do {
        if (++tries > most_tries) refuse_full(number, i, balls);
        for (int axis = 0; axis < 3; ++axis) {
          const Real inset = repeats(axis, group) ? 0 : balls[i].radius;
          balls[i].centre[axis] = random.between(group.lower[axis] + inset, group.upper[axis] - inset);
        }
      } while (hits(grid, all, balls[i]));
      all.push_back({result_.spheres.box.wrapped(balls[i].centre), balls[i].radius});
      grid.place(static_cast<Index>(all.size() - 1), all.back().centre, balls[i].radius);
    }
    return balls;
  }

  /// Whether the group's box goes through the whole of a periodic axis.
  bool repeats(int axis, const SphereGroup& group) const {
    const Real length = result_.spheres.box.length[axis];
    return length > 0 && group.upper[axis] - group.lower[axis] >= length * (1 - 1e-9);
  }

  bool hits(const neighbors::SphereGrid& grid, const std::vector<Ball>& all, const Ball& ball) const {
    const Vector3 length = result_.spheres.box.length, centre = result_.spheres.box.wrapped(ball.centre);
    const auto most = [&](int axis) { return length[axis] > 0 ? 1 : 0; };
    bool hit = false;
    for (int x = -most(0); x <= most(0); ++x)
      for (int y = -most(1); y <= most(1); ++y)
        for (int z = -most(2); z <= most(2); ++z) {
          const Vector3 image = centre + Vector3(x * length.x(), y * length.y(), z * length.z());
          grid.visit_near(image, ball.radius, [&](Index i) {
            const Ball& other = all[static_cast<std::size_t>(i)];
            hit = hit || (other.centre - image).norm() < other.radius + ball.radius;
          });
        }
    return hit;
  }

  [[noreturn]] void refuse_full(std::size_t number, std::size_t placed, const std::vector<Ball>& balls) const {
    const SphereGroup& group = spheres_.spheres[number];
    Real volume = 0;
    for (std::size_t i = 0; i < placed; ++i) volume += 4.18879020478639098462 * std::pow(balls[i].radius, 3);
    const Real share = volume / (group.upper - group.lower).prod();
    refuse(file_, fmt::format("spheres.{}.count", number),
           fmt::format("there is no space for sphere {} of {} of the group \"{}\": the spheres before it fill {} of the box",
                       placed + 1, group.count, group.name, short_number(share, 3)),
           "random places without overlap rarely fill more than 0.35: choose a larger box or fewer spheres, and let them settle "
           "under gravity");
  }

  /// A body must not meet itself through a periodic side, however it turns.
  void check_domain(const Shape& shape, const std::string& name) const {
    for (int axis = 0; axis < 3; ++axis) {
      const Real length = result_.spheres.box.length[axis];
      if (length <= 0 || length > 2 * shape.reach) continue;
      refuse(file_, "domain.upper",
             fmt::format("the domain is {} m long along the periodic axis {}, and a body of the shape \"{}\" may be {} m long",
                         short_number(length, 4), "xyz"[axis], name, short_number(2 * shape.reach, 4)),
             "it would meet itself on the other side: make the domain longer than the body in any position");
    }
  }

  void check_sizes() const {
    Real largest = 0;
    for (const auto& place : result_.spheres.place) largest = std::max(largest, place.radius);
    const Real reach = 2 * largest + search_margin(spheres_, result_.spheres);
    for (int axis = 0; axis < 3; ++axis) {
      const Real length = result_.spheres.box.length[axis];
      if (length <= 0 || length >= 2 * reach) continue;
      refuse(file_, "domain.upper",
             fmt::format("the domain is {} m long along the periodic axis {}, and the diameter of the largest sphere is {} m",
                         short_number(length), "xyz"[axis], short_number(2 * largest)),
             fmt::format("a sphere must not meet another one, or itself, on both sides: {} m or more are needed",
                         short_number(2 * reach, 4)));
    }
  }

  /// The last entry of [[bonds]] whose groups and reach fit a pair of two bodies; -1 where there is none.
  Index entry_of(std::size_t first, std::size_t second, Real gap, Real reach) const {
    if (are_of_one_body(first, second)) return -1;
    const std::string& one = spheres_.spheres[static_cast<std::size_t>(result_.group[first])].name;
    const std::string& other = spheres_.spheres[static_cast<std::size_t>(result_.group[second])].name;
    for (std::size_t entry = spheres_.bonds.size(); entry-- > 0;) {
      const cases::BondRules& bond = spheres_.bonds[entry];
      const bool fits =
          (bond.between[0] == one && bond.between[1] == other) || (bond.between[0] == other && bond.between[1] == one);
      if (fits && gap <= bond.reach * reach * (1 + 1e-9) + 1e-9 * reach) return static_cast<Index>(entry);
    }
    return -1;
  }

  void find_bonded() {
    const state::Spheres& spheres = result_.spheres;
    Real largest = 0, reach = 0;
    for (const auto& place : spheres.place) largest = std::max(largest, place.radius);
    for (const cases::BondRules& bond : spheres_.bonds) reach = std::max(reach, (bond.reach + 1e-6) * 2 * largest);
    if (spheres_.bonds.empty()) return;
    const neighbors::SpherePairs pairs = neighbors::find_pairs(spheres, reach);
    for (std::size_t i = 0; i < spheres.size(); ++i)
      for (std::size_t p = pairs.first[i]; p < pairs.first[i + 1]; ++p) {
        const auto j = static_cast<std::size_t>(pairs.other[p]);
        const Real radii = spheres.place[i].radius + spheres.place[j].radius;
        const Real gap = spheres.box.nearest(spheres.place[j].centre() - spheres.place[i].centre()).norm() - radii;
        if (const Index entry = entry_of(i, j, gap, radii); entry >= 0)
          result_.bonded.push_back({static_cast<Index>(i), static_cast<Index>(j), entry});
      }
    std::ranges::stable_sort(result_.bonded, {}, &BondedPair::first);
  }

  bool are_of_one_body(std::size_t first, std::size_t second) const {
    return (result_.body[first] >= 0 && result_.body[first] == result_.body[second]) ||
           (result_.bonded_body[first] >= 0 && result_.bonded_body[first] == result_.bonded_body[second]);
  }

  /// Whether two spheres are of one body or bonded for good, so that they never touch.
  bool are_joined(std::size_t first, std::size_t second) const {
    if (are_of_one_body(first, second)) return true;
    const std::array wanted{static_cast<Index>(first), static_cast<Index>(second)};
    const auto range = std::ranges::equal_range(result_.bonded, wanted[0], {}, &BondedPair::first);
    return std::ranges::any_of(range, [&](const BondedPair& pair) {
      return pair.second == wanted[1] && !spheres_.bonds[static_cast<std::size_t>(pair.entry)].breaks();
    });
  }

  void check_overlaps() const {
    struct Overlap {
      Real share;
      std::size_t first, second;
    };
    const state::Spheres& spheres = result_.spheres;
    const neighbors::SpherePairs pairs = neighbors::find_pairs(spheres, 0);
    std::vector<Overlap> found;
    for (std::size_t i = 0; i < spheres.size(); ++i)
      for (std::size_t p = pairs.first[i]; p < pairs.first[i + 1]; ++p) {
        const auto j = static_cast<std::size_t>(pairs.other[p]);
        const Vector3 apart = spheres.box.nearest(spheres.place[j].centre() - spheres.place[i].centre());
        const Real overlap = spheres.place[i].radius + spheres.place[j].radius - apart.norm();
        const Real share = overlap / std::min(spheres.place[i].radius, spheres.place[j].radius);
        if (share > spheres_.contact.overlap_limit && !are_joined(i, j)) found.push_back({share, i, j});
      }
    if (found.empty()) return;
    std::ranges::stable_sort(found, std::ranges::greater{}, &Overlap::share);
    std::string list;
    for (std::size_t n = 0; n < std::min(found.size(), most_listed); ++n)
      list += fmt::format("{}{} and {} by {}", n > 0 ? ", " : "", name_of(found[n].first), name_of(found[n].second),
                          short_number(found[n].share, 3));
    refuse(file_, "contact.overlap_limit",
           fmt::format("{} pairs of spheres overlap at the start by more than {} of the smaller radius: {}{}", found.size(),
                       short_number(spheres_.contact.overlap_limit), list, found.size() > most_listed ? " ..." : ""),
           "move them apart, or raise overlap_limit where they are meant to be pressed together");
  }

  /// "bed 12 at (0, 0, 1)": counted from 1 within the group.
  std::string name_of(std::size_t sphere) const {
    const Index group = result_.group[sphere];
    const auto first = std::ranges::find(result_.group, group) - result_.group.begin();
    const auto& at = result_.spheres.place[sphere];
    return fmt::format("{} {} at ({}, {}, {})", spheres_.spheres[static_cast<std::size_t>(group)].name,
                       static_cast<std::ptrdiff_t>(sphere) - first + 1, short_number(at.x, 4), short_number(at.y, 4),
                       short_number(at.z, 4));
  }

  const cases::CaseFile& file_;
  const cases::SpheresCase& spheres_;
  Placement result_;
};

}  // namespace

Real search_margin(const cases::SpheresCase& spheres, const state::Spheres& placed) {
  const auto smallest = std::ranges::min_element(placed.place, {}, &state::SpherePlace::radius);
  return smallest == placed.place.end() ? 0 : spheres.contact.margin * 2 * smallest->radius;
}

Placement place_spheres(const cases::CaseFile& file) { return Placer(file).place(); }

}  // namespace sazare::runs
