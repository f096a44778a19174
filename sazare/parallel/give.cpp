#include "sazare/parallel/give.hpp"

#include <cstring>
#include <utility>

namespace sazare::parallel {

std::vector<std::vector<std::byte>> give(const Ranks& ranks, std::vector<std::vector<std::byte>> to_each, Topic topic) {
  std::vector<std::uint64_t> sizes;
  for (const auto& bytes : to_each) sizes.push_back(bytes.size());
  const Gathered gathered = ranks.gather(std::as_bytes(std::span(sizes)), Topic::other);
  std::vector<Message> sent, received;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    if (rank == ranks.rank()) continue;
    std::vector<std::byte>& bytes = to_each[static_cast<std::size_t>(rank)];
    if (!bytes.empty()) sent.push_back({rank, std::exchange(bytes, {})});
    std::uint64_t coming = 0;
    std::memcpy(&coming, gathered.of(rank).data() + static_cast<std::size_t>(ranks.rank()) * sizeof coming, sizeof coming);
    if (coming > 0) received.push_back({rank, std::vector<std::byte>(coming)});
  }
  ranks.exchange(sent, received, topic);
  for (Message& message : received) to_each[static_cast<std::size_t>(message.rank)] = std::move(message.bytes);
  return to_each;
}

}  // namespace sazare::parallel
