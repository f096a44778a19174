#include "sazare/methods/fem/run/incident_wave.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/fem/case/case.hpp"
#include "sazare/methods/fem/inclined_waves/inclined_field.hpp"
#include "sazare/methods/fem/soil_column.hpp"

namespace sazare::runs {
namespace {

namespace fem = methods::fem;
using cases::short_number;

constexpr Real degree = std::numbers::pi / 180;

fem::WaveKind kind_of(cases::IncidentWaveKind kind) {
  switch (kind) {
    case cases::IncidentWaveKind::p:
      return fem::WaveKind::p;
    case cases::IncidentWaveKind::sh:
      return fem::WaveKind::sh;
    default:
      return fem::WaveKind::sv;
  }
}

template <int D>
class WaveChecks {
public:
  WaveChecks(const cases::CaseFile& file, const fem::BodyDescription& body, const fem::Supports<D>& supports)
      : file_(file), body_(body), mesh_(body.mesh), supports_(supports), wave_(*supports.wave) {}

  void check() const {
    for (const auto& side : supports_.sides) {
      check_layers(side);
      check_surface(side);
      check_angle(side);
      check_members(side);
    }
    check_base();
    for (const auto& boundary : supports_.viscous) check_free(boundary.surface);
    for (const auto& side : supports_.sides) check_free(side.surface);
  }

private:
  const geometry::ElementMesh& column(const fem::FreeFieldSide<D>& side) const { return side.column->body.mesh; }
  Real foot(const fem::FreeFieldSide<D>& side) const { return column(side).nodes.front()[D - 1]; }
  std::string name(const fem::FreeFieldSide<D>& side) const {
    return fmt::format("the side at {} = {} m", "xy"[side.across], short_number(column(side).nodes.front()[side.across]));
  }

  void check_layers(const fem::FreeFieldSide<D>& side) const {
    const fem::BodyDescription& body = side.column->body;
    for (const Index number : body.material) {
      const fem::SolidMaterial& material = body.materials[at(number)];
      const bool wet = material.saturation && material.saturation->flow;
      if (!material.backbone && !wet) continue;
      refuse(
          file_, "incident_wave.angle",
          fmt::format("\"{}\" at {} {}, and a wave at an angle runs through elastic layers only", material.name, name(side),
                      wet ? "has water that flows or cannot drain" : "degrades"),
          "give the ground beside the sides a material without it, or let the wave come up vertically: motion_x of the viscous "
          "base instead of [incident_wave]");
    }
  }

  void check_surface(const fem::FreeFieldSide<D>& side) const {
    const fem::Supports<D>& own = side.column->supports;
    const bool grows = std::ranges::any_of(own.waters, [](const auto& water) { return water.pressure.ramp > 0; });
    if (own.loads.empty() && !grows) return;
    refuse(
        file_, "incident_wave", fmt::format("a load on the surface reaches {}", name(side)),
        "with an incident wave the ground beside the sides bears its weight and still water alone: end the load before the side");
  }

  /// The free field has no beams and bars: one that reaches a side ends there for the wave.
  void check_members(const fem::FreeFieldSide<D>& side) const {
    const std::set<Index> nodes = nodes_of(side.surface);
    for (std::size_t i = 0; i < body_.members.size(); ++i)
      for (const auto& line : body_.members[i].lines)
        if (nodes.contains(line[0]) || nodes.contains(line[1]))
          refuse(file_, fmt::format("members.{}", i),
                 fmt::format("the member \"{}\" reaches {}", body_.members[i].name, name(side)),
                 "the wave beside the sides runs through ground alone, and would come back from the member's end: end the member "
                 "some "
                 "elements before the side");
  }

  void check_angle(const fem::FreeFieldSide<D>& side) const {
    const Real most = fem::critical_angle(fem::elastic_layers(side, {}), wave_.kind);
    if (std::abs(wave_.angle) < 0.999 * most) return;
    refuse(file_, "incident_wave.angle",
           fmt::format("at {} deg the wave runs along a layer at {} instead of through it: the critical angle is {} deg",
                       short_number(std::abs(wave_.angle) / degree), name(side), short_number(most / degree, 3)),
           fmt::format("choose an angle below {} deg", short_number(0.999 * most / degree, 3)));
  }

  /// Whether the wave moves the ground along an axis.
  bool moves(int axis) const {
    if (D == 2 || axis == D - 1) return D == 2 || wave_.kind != fem::WaveKind::sh;
    const Real along = axis == 0 ? std::cos(wave_.azimuth) : std::sin(wave_.azimuth),
               across = axis == 0 ? std::sin(wave_.azimuth) : std::cos(wave_.azimuth);
    return std::abs(wave_.kind == fem::WaveKind::sh ? across : along) > 1e-9;
  }

  static std::set<Index> nodes_of(const std::vector<geometry::MeshElement>& faces) {
    std::set<Index> nodes;
    for (const auto& face : faces) nodes.insert(face.node_list().begin(), face.node_list().end());
    return nodes;
  }

  /// The free field has no supports: at faces that follow it nothing else holds what the wave moves.
  void check_free(const std::vector<geometry::MeshElement>& faces) const {
    const std::set<Index> nodes = nodes_of(faces);
    for (const fem::Support& held : supports_.held) {
      if (!nodes.contains(held.node) || !moves(held.axis)) continue;
      const Vector3& place = mesh_.nodes[at(held.node)];
      refuse(
          file_, fmt::format("boundaries.{}.group", held.boundary),
          fmt::format("\"{}\" holds a node of the base or a side at ({}, {}, {}) m along {}, and the wave moves the ground there",
                      file_.as<cases::FemCase>().boundaries[at(held.boundary)].group, short_number(place.x()),
                      short_number(place.y()), short_number(place.z()), "xyz"[held.axis]),
          "with an incident wave the base is viscous, the sides are of kind free_field, and nothing else holds either");
    }
  }

  /// The wave comes from one half space below a level base.
  void check_base() const {
    const auto& first = supports_.sides.front();
    const Real extent = column(first).nodes.back()[D - 1] - foot(first);
    for (const auto& side : supports_.sides) {
      if (std::abs(foot(side) - foot(first)) > 1e-6 * extent)
        refuse(file_, "incident_wave", fmt::format("{} and {} end at different elevations", name(first), name(side)),
               "an incident wave requires a level base: let all sides reach down to it");
      if (side.column->body.material.front() != first.column->body.material.front())
        refuse(file_, "incident_wave", fmt::format("{} and {} stand on different materials", name(first), name(side)),
               "the wave comes from one half space: give the ground along the base one material");
    }
    for (const auto& boundary : supports_.viscous)
      for (const Index node : boundary.nodes)
        if (std::abs(mesh_.nodes[at(node)][D - 1] - foot(first)) > 1e-6 * extent)
          refuse(file_, fmt::format("boundaries.{}.group", boundary.boundary),
                 fmt::format("the viscous boundary \"{}\" reaches an elevation of {} m, and the sides end at {} m",
                             file_.as<cases::FemCase>().boundaries[at(boundary.boundary)].group,
                             short_number(mesh_.nodes[at(node)][D - 1]), short_number(foot(first))),
                 "with an incident wave the base is level and viscous, and the vertical sides are of kind free_field");
  }

  const cases::CaseFile& file_;
  const fem::BodyDescription& body_;
  const geometry::ElementMesh& mesh_;
  const fem::Supports<D>& supports_;
  const fem::IncidentWave& wave_;
};

}  // namespace

template <int D>
void add_incident_wave(const cases::CaseFile& file, const fem::BodyDescription& body, fem::Supports<D>& supports) {
  const auto& given = file.as<cases::FemCase>();
  if (!given.incident_wave.is_there()) return;
  fem::IncidentWave wave{kind_of(given.incident_wave.kind), given.incident_wave.angle * degree,
                         given.incident_wave.azimuth * degree, 0, given.time.end};
  const auto found = std::ranges::find(given.motions, given.incident_wave.motion, &cases::Motion::name);
  wave.motion = static_cast<Index>(found - given.motions.begin());
  supports.wave = wave;
  WaveChecks<D>(file, body, supports).check();
}

template <int D>
std::string incident_wave_line(const fem::Supports<D>& supports) {
  if (!supports.wave) return {};
  const fem::LayeredGround ground(fem::elastic_layers(supports.sides.front(), {}), supports.wave->kind, supports.wave->angle);
  const Real slowness = std::abs(ground.slowness());
  return cases::line("wave", slowness > 0 ? fmt::format("travels along the base at {} m/s", short_number(1 / slowness))
                                          : "reaches the whole base at once");
}

#define SAZARE_INSTANTIATE(D)                                                                                 \
  template void add_incident_wave<D>(const cases::CaseFile&, const fem::BodyDescription&, fem::Supports<D>&); \
  template std::string incident_wave_line<D>(const fem::Supports<D>&);
SAZARE_INSTANTIATE(2)
SAZARE_INSTANTIATE(3)
#undef SAZARE_INSTANTIATE

}  // namespace sazare::runs
