#include "sazare/methods/spheres/ranks/step_messages.hpp"

namespace sazare::methods::spheres {

StepMessages::StepMessages(const parallel::Ranks& ranks) : ranks_(&ranks) {
  for (int rank = 0; rank < ranks.size(); ++rank) sent_.push_back({rank, {}});
  received_ = sent_;
}

void StepMessages::plan(int rank, std::size_t going, std::size_t coming) {
  sent_[static_cast<std::size_t>(rank)].bytes.resize(going);
  received_[static_cast<std::size_t>(rank)].bytes.resize(coming);
  planned_.bytes += static_cast<std::int64_t>(going);
  planned_.messages += going > 0 ? 1 : 0;
}

void StepMessages::exchange() { ranks_->exchange(sent_, received_, parallel::Topic::motion); }

}  // namespace sazare::methods::spheres
