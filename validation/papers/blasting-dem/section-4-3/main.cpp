#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "validation/common/blast.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using validation::print_row;

struct Result {
  std::vector<Vector3> displacement;
  std::vector<std::size_t> near_hole;
  std::set<std::pair<Index, Index>> broken;  ///< joints, by their elements

  /// Mean distance moved by the elements near the hole [m].
  Real moved() const {
    Real sum = 0;
    for (const std::size_t element : near_hole) sum += displacement[element].norm();
    return sum / static_cast<Real>(near_hole.size());
  }
  Real broken_count() const { return static_cast<Real>(broken.size()); }
};

Result result_of(const std::vector<std::string>& overrides) {
  auto model = validation::started_blast(overrides);
  validation::advance_to(model, 5e-4);
  Result result{validation::displacements(model), {}, {}};
  for (std::size_t element = 0; element < result.displacement.size(); ++element)
    if (validation::distance_from_hole(model, element) < 0.15) result.near_hole.push_back(element);
  const auto joints = model.joints->links();
  for (std::size_t joint = 0; joint < joints.size(); ++joint)
    if (model.joints->state(static_cast<Index>(joint)) == methods::blocks::JointState::broken)
      result.broken.insert(std::minmax(joints[joint].first, joints[joint].second));
  return result;
}

/// Largest difference of an element near the hole over what it moved.
Real largest_near_hole(const Result& one, const Result& other) {
  Real largest = 0;
  for (const std::size_t element : other.near_hole) {
    const Vector3& moved = other.displacement[element];
    largest = std::max(largest, (one.displacement[element] - moved).norm() / moved.norm());
  }
  return largest;
}

/// Joints broken in one of two results only, over those broken in the second.
Real broken_in_one_only(const Result& one, const Result& other) {
  std::vector<std::pair<Index, Index>> apart;
  std::ranges::set_symmetric_difference(one.broken, other.broken, std::back_inserter(apart));
  return static_cast<Real>(apart.size()) / other.broken_count();
}

void print_comparison(const std::string& name, const Result& one, const Result& other) {
  const auto print = [&](const char* row, auto... values) { print_row((name + "-" + row).c_str(), values...); };
  print("near-hole", one.moved(), other.moved());
  print("largest", largest_near_hole(one, other));
  print("all", validation::relative_difference(one.displacement, other.displacement));
  print("broken", one.broken_count(), other.broken_count());
  print("broken-set", broken_in_one_only(one, other));
}

}  // namespace

int main() {
  const Result mixed = result_of({});
  const Result uniform = result_of({"time.levels=\"uniform\""});
  print_comparison("stability", mixed, uniform);
  print_row("broken", mixed.broken_count());
  const Result fixed = result_of({"time.levels=\"uniform\"", "time.limiter=\"none\"", "time.base_step=1e-8"});
  const Result travel = result_of({"time.limiter=\"travel\"", "time.base_step=1e-8", "time.travel_length=1e-7"});
  print_comparison("travel", travel, fixed);
}
