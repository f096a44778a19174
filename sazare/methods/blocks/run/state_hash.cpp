#include "sazare/methods/blocks/run/state_hash.hpp"

#include <array>
#include <span>

#include "sazare/observe/hash.hpp"

namespace sazare::runs {

namespace {

template <class Numbers>
void add(observe::PieceHash& hash, const Numbers& numbers) {
  hash.add(std::as_bytes(std::span(numbers.data(), static_cast<std::size_t>(numbers.size()))));
}

}  // namespace

std::uint64_t state_hash(const BlocksModel& model) {
  observe::Hash hash;
  hash.add_pieces([&](observe::PieceHash& motion) {
    const levels::Snapshot<3> now = model.simulation->snapshot();
    for (std::size_t element = 0; element < now.pose.size(); ++element) {
      add(motion, now.pose[element].position);
      add(motion, now.pose[element].rotation);
      add(motion, now.velocity[element]);
      add(motion, now.angular_momentum[element]);
      if (now.strain.empty()) continue;
      add(motion, now.strain[element].strain);
      add(motion, now.strain[element].rate);
    }
  });
  hash.add_pieces([&](observe::PieceHash& memory) {
    for (Index joint = 0; joint < model.joints->count(); ++joint) {
      const methods::blocks::JointRecord& record = model.joints->record(joint);
      add(memory, std::array{static_cast<Real>(record.state)});
      for (const auto& [corner, peak] : record.vertex) {
        add(memory, corner);
        add(memory, std::array{peak});
      }
    }
  });
  const auto paths = model.joints->slip_paths();
  if (!paths.empty())
    hash.add_pieces([&](observe::PieceHash& memory) {
      for (const methods::blocks::SlipPath& path : paths) add(memory, path);
    });
  return hash.value();
}

}  // namespace sazare::runs
