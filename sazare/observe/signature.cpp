#include "sazare/observe/signature.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <system_error>

namespace sazare::observe {
namespace {

namespace fs = std::filesystem;

struct SipState {
  std::uint64_t v0, v1, v2, v3;

  void round() {
    v0 += v1;
    v1 = std::rotl(v1, 13) ^ v0;
    v0 = std::rotl(v0, 32);
    v2 += v3;
    v3 = std::rotl(v3, 16) ^ v2;
    v0 += v3;
    v3 = std::rotl(v3, 21) ^ v0;
    v2 += v1;
    v1 = std::rotl(v1, 17) ^ v2;
    v2 = std::rotl(v2, 32);
  }
  void take(std::uint64_t word) {
    v3 ^= word;
    round();
    round();
    v0 ^= word;
  }
};

/// Where the key is kept; empty where the user has no folder.
fs::path key_file() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/')
    return fs::path(data) / "sazare" / "checkpoint-key";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return fs::path(home) / ".local" / "share" / "sazare" / "checkpoint-key";
  return {};
}

std::optional<SignatureKey> read_key(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  SignatureKey key{};
  if (!in.read(reinterpret_cast<char*>(key.data()), sizeof key)) return std::nullopt;
  return key;
}

/// Draws a key and keeps it, unless another process has just done so. Whoever links its file to the name first has made the key.
void make_key(const fs::path& file) {
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  std::random_device random;
  SignatureKey key{};
  for (std::uint64_t& word : key) word = (std::uint64_t{random()} << 32) | random();
  const fs::path drawn = fmt::format("{}.{}", file.string(), ::getpid());
  const int descriptor = ::open(drawn.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (descriptor < 0) return;
  const bool written = ::write(descriptor, key.data(), sizeof key) == static_cast<ssize_t>(sizeof key);
  ::close(descriptor);
  if (written) fs::create_hard_link(drawn, file, ignored);
  fs::remove(drawn, ignored);
}

/// A key for those who cannot keep one: others who share the machine and know how it is made could make it too.
SignatureKey key_of_machine() {
  std::ifstream in("/etc/machine-id");
  std::ostringstream text;
  text << in.rdbuf() << ::getuid();
  const std::string words = text.str();
  const auto bytes = std::as_bytes(std::span(words));
  return {siphash({1, 2}, bytes), siphash({3, 4}, bytes)};
}

}  // namespace

std::uint64_t siphash(const SignatureKey& key, std::span<const std::byte> bytes) {
  SipState state{key[0] ^ 0x736f6d6570736575ULL, key[1] ^ 0x646f72616e646f6dULL, key[0] ^ 0x6c7967656e657261ULL,
                 key[1] ^ 0x7465646279746573ULL};
  const std::size_t whole = bytes.size() / 8 * 8;
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < whole; i += 8) {
    std::memcpy(&word, bytes.data() + i, 8);
    state.take(word);
  }
  word = static_cast<std::uint64_t>(bytes.size()) << 56;
  for (std::size_t i = whole; i < bytes.size(); ++i) word |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * (i - whole));
  state.take(word);
  state.v2 ^= 0xff;
  for (int n = 0; n < 4; ++n) state.round();
  return state.v0 ^ state.v1 ^ state.v2 ^ state.v3;
}

std::uint64_t signature_of(const SignatureKey& key, const std::string& name, std::span<const std::byte> bytes) {
  const std::uint64_t of_name = siphash(key, std::as_bytes(std::span(name)));
  return siphash({key[0], key[1] ^ of_name}, bytes);
}

SignatureKey signature_key() {
  const fs::path file = key_file();
  if (file.empty()) return key_of_machine();
  if (const auto key = read_key(file)) return *key;
  make_key(file);
  return read_key(file).value_or(key_of_machine());
}

bool trusts_checkpoints() {
  const char* trust = std::getenv("SAZARE_TRUST_CHECKPOINT");
  return trust != nullptr && std::strcmp(trust, "1") == 0;
}

}  // namespace sazare::observe
