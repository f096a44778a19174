#include "sazare/runs/state_hash.hpp"

#include <span>
#include <vector>

#include "sazare/observe/hash.hpp"

namespace sazare::runs {

namespace {

template <class Matrix>
void append(std::vector<Real>& numbers, const Matrix& matrix) {
  numbers.insert(numbers.end(), matrix.data(), matrix.data() + matrix.size());
}

}  // namespace

std::uint64_t state_hash(const BlocksModel& model) {
  const engine::Snapshot<3> now = model.simulation->snapshot();
  std::vector<Real> motion, memory;
  for (std::size_t element = 0; element < now.pose.size(); ++element) {
    append(motion, now.pose[element].position);
    append(motion, now.pose[element].rotation);
    append(motion, now.velocity[element]);
    append(motion, now.angular_momentum[element]);
  }
  for (Index joint = 0; joint < model.joints->count(); ++joint) {
    const methods::blocks::JointReport report = model.joints->report(joint);
    memory.insert(memory.end(), {static_cast<Real>(report.state), report.opening, report.slip});
  }
  observe::Hash hash;
  hash.add(std::as_bytes(std::span(motion)));
  hash.add(std::as_bytes(std::span(memory)));
  return hash.value();
}

}  // namespace sazare::runs
