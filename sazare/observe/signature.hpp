#pragma once

/// Signatures by which a user knows his own files again. A checkpoint goes into the memory of a run as it is, so one that
/// somebody made up could let the run read and write anywhere; only those with the user's signature are read without asking.
///
/// The signature is SipHash-2-4 [Aumasson and Bernstein, Indocrypt 2012] of name and bytes, under a key that the user alone can
/// read.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace sazare::observe {

using SignatureKey = std::array<std::uint64_t, 2>;

std::uint64_t siphash(const SignatureKey& key, std::span<const std::byte> bytes);

/// The signature of named bytes.
std::uint64_t signature_of(const SignatureKey& key, const std::string& name, std::span<const std::byte> bytes);

/// The key of this user, which `$XDG_DATA_HOME/sazare/checkpoint-key` keeps (`~/.local/share/sazare/checkpoint-key`); it is drawn
/// when it is first needed. Where no file can be kept, a key that follows from the machine and the user.
SignatureKey signature_key();

/// Whether the user said that checkpoints of others are to be read: SAZARE_TRUST_CHECKPOINT is 1 in the environment, as
/// --trust-checkpoint sets it.
bool trusts_checkpoints();

}  // namespace sazare::observe
