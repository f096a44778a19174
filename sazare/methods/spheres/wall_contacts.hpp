#pragma once

/// Contacts of spheres with walls: planes, see PlaneRow, and surfaces.
///
/// Walls that are joined are one surface. A sphere touches it in points that count so that the force has an energy (see
/// geometry/facets/complex.hpp): a flat surface, an outer edge or a corner pushes once, however many triangles share it, and the
/// two sides of a groove push both.
///
/// A centre beyond a surface would be pushed on to the wrong side: that it went through is seen and kept.

#include <optional>
#include <span>
#include <utility>

#include "sazare/geometry/facets/points.hpp"
#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/methods/spheres/load_table.hpp"
#include "sazare/methods/spheres/plane_contacts.hpp"
#include "sazare/methods/spheres/ranks/rank_tiles.hpp"
#include "sazare/methods/spheres/wall.hpp"

namespace sazare::methods::spheres {

class WallContacts {
public:
  /// Materials of walls are numbered like those of the spheres. `reach`: largest radius and margin together [m].
  WallContacts(ContactTable table, std::vector<Wall> walls, Real reach);

  /// Spheres may be worked on in parts, each at times of its own.
  struct Parts {
    std::size_t count = 1;
    std::span<const std::int8_t> of;  ///< by place; empty: all are in part 0
    RankTiles* ranks = nullptr;       ///< where several share the spheres: each finds those of its own tiles

    bool owns(std::size_t tile) const { return ranks == nullptr || ranks->owners().owns(tile); }
  };

  /// Notes whether spheres went through surfaces since they were last evaluated; to be called before `find`, while all stand
  /// where they did.
  void look_back(const state::Spheres& spheres, Real time);
  /// Finds which spheres are nearer to a wall than the margin [m]. `new_place` says where each sphere stands that stood at a
  /// place when they were last found; empty where all stand as they did.
  void find(const state::Spheres& spheres, Real time, Real margin, std::span<const Index> new_place, const Parts& parts);

  /// Whether walls stand still from the next `move` on: where they were at the last one, and without velocity.
  void stand_still(bool still) { stand_still_ = still; }

  /// To be called once before the tiles of a step.
  void move(Real time);

  /// To be called after the tiles of a part: whether a sphere went through a surface.
  void note_passages(std::size_t part);
  /// The first sphere whose centre went through a surface, between two evaluations or two searches; nothing where none did.
  const std::optional<Passage>& passage() const { return passage_; }
  /// In which tile its sphere was; below 0 where none.
  std::int64_t passage_tile() const { return passage_tile_; }
  /// Takes that of another rank.
  void agree_on(const Passage& passage, std::int64_t tile) {
    passage_ = passage;
    passage_tile_ = tile;
  }
  bool have_surfaces() const;

  /// Adds a wall, whose nodes are led from outside; one at most.
  void add_surface(Wall wall);
  /// The wall that moves with its nodes; nullptr where there is none.
  const geometry::NodalSurface* surface() const { return surface_ < walls_.size() ? &walls_[surface_].nodal : nullptr; }
  Real lead(Real time, Real step, std::vector<Vector3> from, std::vector<Vector3> with);
  /// To be called once after the tiles of a step: what its nodes have got.
  void add_work_of_surface(Real step);

  /// The spheres of a part in a tile.
  struct Task {
    std::size_t tile = 0;
    Real step = 0;           ///< [s]
    state::SphereLoad* own;  ///< the loads of the tile's spheres
    std::size_t part = 0;
  };

  /// Adds the forces on spheres to their loads.
  ContactSums evaluate(const state::Spheres& spheres, const Task& task);

  /// Calls `visit(sphere, material, normal, overlap)` with the place of the sphere of every contact of a part in a tile, the
  /// material of the wall, the normal towards the wall, and the overlap [m]: at planes now, at surfaces as last evaluated.
  template <class Visit>
  void visit_contacts(const state::Spheres& spheres, std::size_t part, std::size_t number, Visit&& visit) const {
    if (part >= parts_.size() || number >= parts_[part].size()) return;
    const Tile& tile = parts_[part][number];
    for (std::size_t w = 0; w < tile.planes.size(); ++w)
      for (std::size_t n = 0; n < tile.planes[w].size(); ++n) {
        const state::SpherePlace& place = spheres.place[static_cast<std::size_t>(tile.planes[w][n])];
        const Vector3 centre = seen_by(w, spheres.box.wrapped(place.centre()));
        const Real overlap = place.radius - (centre - walls_[w].point).dot(walls_[w].normal);
        if (overlap > 0) visit(tile.planes[w][n], walls_[w].material, -poses_[w].direction_out(walls_[w].normal), overlap);
      }
    for (std::size_t n = 0; n < tile.points.size(); ++n)
      if (const Point& point = tile.points[n]; point.overlap > 0)
        visit(tile.touches[n].sphere, walls_[static_cast<std::size_t>(point.wall)].material, -point.normal, point.overlap);
  }

  const ContactTable& table() const { return table_; }
  const std::vector<Wall>& walls() const { return walls_; }
  /// By wall, as last evaluated.
  std::vector<WallLoad> loads() const;
  /// The same before it is rounded; sums over tiles, which do not depend on their order.
  std::vector<WallLoadSums> load_sums() const;
  /// The largest speed of any wall within `radius` of its pivot, so anywhere near the spheres [m/s].
  Real largest_speed(Real radius) const;

  void columns(Archive& archive);
  /// With several ranks: the first one comes to know all loads, for `loads`; and all touches, for the next `columns` that writes.
  void survey(const RankTiles& ranks);
  void collect(const RankTiles& ranks);

  /// A point where a sphere touches, and what it remembers.
  struct Touch {
    Index sphere = 0;
    Index wall = 0;
    Vector3 normal = Vector3::Zero();   ///< from the wall to the sphere; not needed at a plane
    Vector3 sliding = Vector3::Zero();  ///< [sqrt(J)], as the next two, see laws::ContactMemory; not used where there are bands
    Vector3 rolling = Vector3::Zero();
    Real twisting = 0;
    Real share = 0;  ///< see FacetPoint; 0: remembers nothing
  };

private:
  using Bands = laws::SlipBands<Real>;
  /// Touches with their bands, where there are any.
  struct Kept {
    std::vector<Touch> touches;
    std::vector<Bands> bands;

    void add(const Kept& more) {
      touches.insert(touches.end(), more.touches.begin(), more.touches.end());
      bands.insert(bands.end(), more.bands.begin(), more.bands.end());
    }
    template <class Parcel>
    void carry(Parcel& parcel) {
      parcel(touches);
      parcel(bands);
    }
  };
  /// A triangle near a sphere.
  struct Near {
    Index sphere = 0, wall = 0;
    std::int32_t triangle = 0;
    Vector3 before = Vector3::Zero();  ///< where the sphere's centre was last seen, from the triangle's middle [m]
  };
  /// Where a sphere touches a surface now.
  struct Point {
    Index wall = 0;
    std::int32_t triangle = 0;
    Real overlap = 0;  ///< [m]
    Vector3 centre;    ///< of the sphere, within a periodic box [m]
    Vector3 foot;      ///< on the wall, where that was at the start [m]
    Vector3 normal;    ///< from the wall to the sphere
    Real count = 1, share = 1;         ///< of its energy, and of what it dissipates
    Vector3 slope = Vector3::Zero();   ///< of the count, as the centre moves [1/m]
    Vector3 before = Vector3::Zero();  ///< the normal at the last step; what begins to touch has this one
  };
  struct Tile {
    std::vector<PlaneRow> planes;  ///< by wall; those of surfaces are empty
    std::vector<Near> near;        ///< by sphere
    std::vector<Touch> touches;    ///< of surfaces, by sphere
    std::vector<Bands> bands;      ///< those of the touches; empty where friction does not slip in part
    std::vector<Point> points;     ///< at which the touches act
    std::vector<Touch> before;     ///< touches of the last step; those that go on have the complement of their wall in the end
    std::vector<Bands> bands_before;  ///< those of the touches before
    Real parting_loss = 0;      ///< of touches that ended [J]
    std::vector<WallLoad> loads;             ///< by wall
    std::vector<geometry::NodeForce> on_nodes;  ///< of the surface [N]
    std::optional<Passage> passage;
  };
  /// Walls that are one, whose facets stand one wall after the other.
  struct Surface {
    std::vector<Index> walls;
    std::vector<Index> first;  ///< facet, by wall of them
    geometry::FacetComplex complex;
  };
  /// A facet of a surface that a sphere may touch.
  struct Reached {
    Index surface = 0;
    geometry::NearFacet facet;
  };
  /// How the points of a sphere follow from its touches before.
  struct Followed {
    std::vector<const Touch*> own;  ///< that go on in them, by point
    std::vector<Real> grown;        ///< share that a point has more than that, by point
    std::vector<Real> lost;         ///< share that a touch before has no more, by touch
  };
  /// A part of what a touch before remembers.
  struct Part {
    const Touch* touch = nullptr;
    Real weight = 0;
  };
  /// How a surface moves where it is touched.
  struct Ground {
    Real arm = 0;  ///< from the sphere's centre [m]
    Vector3 place, velocity, spin;
    std::optional<geometry::FacePoint> face;  ///< of a surface with nodes
  };

  geometry::Triangle triangle(std::size_t wall, std::int32_t number) const;
  Vector3 seen_by(std::size_t wall, const Vector3& place) const;
  void places_seen_by(std::size_t wall, const state::SpherePlace& place, const state::PeriodicBox& box, Real margin,
                      std::vector<Vector3>& places) const;
  void find_near(const state::Spheres& spheres, std::size_t sphere, Real margin, Tile& tile) const;
  void find_surface(std::size_t wall, const state::Spheres& spheres, std::size_t sphere, Real margin,
                    std::vector<Near>& near) const;
  bool went_through(Near& one, const geometry::Triangle& corners, const Vector3& centre, Real distance,
                    const state::PeriodicBox& box) const;
  Ground ground_at(const Point& point, Real radius) const;
  void find_points(const state::Spheres& spheres, const Vector3& place, std::span<Near> near, Tile& tile) const;
  void take_points(Index sphere, std::size_t begin, std::span<Touch> before, Tile& tile) const;
  void note_parted(const state::Spheres& spheres, Tile& tile) const;
  void add_points(Index surface, const Vector3& place, Real radius, Real reach, std::span<const geometry::NearFacet> facets,
                  std::vector<Point>& points) const;
  void join_walls();
  void build(Surface& surface, std::span<const Index> planes);
  const Touch* like(const Point& point, std::span<const Touch> before) const;
  void follow(std::size_t begin, std::span<Touch> before, std::vector<Point>& points, Followed& followed) const;
  void find_parts(std::size_t n, std::span<const Point> points, std::span<const Touch> before, const Followed& followed,
                  std::vector<Part>& parts) const;
  Bands bands_of(std::span<const Part> parts, std::span<const Touch> before, std::span<const Bands> bands,
                 const Vector3& normal) const;
  Index surface_of(Index wall) const { return surface_of_[static_cast<std::size_t>(wall)]; }
  void touch_anew(const state::Spheres& spheres, Tile& tile) const;
  Kept kept_by(const Tile& tile) const;
  Kept kept() const;
  static Kept hand_on(const Kept& before, RankTiles& ranks);
  void remember(const Touch& touch, const Bands* bands, Tile& tile) const;
  using Push = ContactSums (WallContacts::*)(const state::Spheres& spheres, std::size_t begin, const Task& task,
                                             Tile& tile) const;
  Push push_of_table() const;
  template <bool rolls>
  struct InLanes;
  template <class Law, bool rolls>
  ContactSums push(const state::Spheres& spheres, std::size_t begin, const Task& task, Tile& tile) const;
  void deliver(std::size_t n, const Ground& ground, const Vector3& force, const Vector3& turning, const Task& task,
               Tile& tile) const;
  void deliver_at_centre(std::size_t n, const Ground& ground, const Vector3& force, const Task& task, Tile& tile) const;

  ContactTable table_;
  std::vector<Wall> walls_;
  std::vector<geometry::TriangleTree> trees_;  ///< by wall
  std::vector<Surface> surfaces_;
  static constexpr Index no_surface = -1, lies_in_another = -2;
  std::vector<Index> surface_of_;  ///< by wall; planes have none, and those that lie in another one do not push
  std::vector<WallPose> poses_;
  bool stand_still_ = false;
  Real reach_ = 0;
  Real time_ = 0;                                       ///< of the last `move` [s]
  std::size_t surface_ = static_cast<std::size_t>(-1);  ///< which of the walls moves with its nodes
  std::vector<std::vector<Tile>> parts_;                ///< by part and tile
  std::optional<Passage> passage_;
  std::int64_t passage_tile_ = -1;
  std::vector<Kept> collected_;         ///< by part and tile
  std::vector<WallLoadSums> surveyed_;  ///< by wall
};

}  // namespace sazare::methods::spheres
