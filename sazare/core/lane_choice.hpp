#pragma once

/// Which of many numbers are chosen, without a branch for each.

#ifdef __AVX2__
#include <immintrin.h>
#endif

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sazare {

/// Room that `choose_up_to` needs behind the last place it can choose.
inline constexpr std::size_t choice_spare = 16;

/// Puts the places of the numbers that are not above a limit into `chosen`, in order and counted from `offset`; says how many.
/// `chosen` has `choice_spare` places more than there are numbers.
inline std::size_t choose_up_to(float limit, std::span<const float> numbers, std::uint32_t offset,
                                std::span<std::uint32_t> chosen) {
  std::size_t count = 0, n = 0;
#ifdef __AVX512F__
  const __m512i steps = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  for (; n < numbers.size(); n += 16) {
    const std::size_t left = numbers.size() - n;
    const auto present = static_cast<__mmask16>(left < 16 ? (1u << left) - 1 : 0xffffu);
    const __m512 some = _mm512_maskz_loadu_ps(present, &numbers[n]);
    const __mmask16 yes = _mm512_mask_cmp_ps_mask(present, some, _mm512_set1_ps(limit), _CMP_LE_OQ);
    const __m512i places = _mm512_add_epi32(steps, _mm512_set1_epi32(static_cast<int>(offset + n)));
    _mm512_storeu_si512(&chosen[count], _mm512_maskz_compress_epi32(yes, places));
    count += static_cast<std::size_t>(std::popcount(static_cast<unsigned>(yes)));
  }
#elif defined(__AVX2__) && defined(__BMI2__)
  for (; n + 8 <= numbers.size(); n += 8) {
    const __m256 some = _mm256_loadu_ps(&numbers[n]);
    const auto yes = static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(some, _mm256_set1_ps(limit), _CMP_LE_OQ)));
    const std::uint64_t a_byte_each = _pdep_u64(yes, 0x0101010101010101u) * 0xff;
    const auto steps = static_cast<long long>(_pext_u64(0x0706050403020100u, a_byte_each));  // of those chosen, pushed together
    const __m256i places =
        _mm256_add_epi32(_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(steps)), _mm256_set1_epi32(static_cast<int>(offset + n)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(&chosen[count]), places);
    count += static_cast<std::size_t>(std::popcount(yes));
  }
#endif
  for (; n < numbers.size(); ++n) {
    chosen[count] = offset + static_cast<std::uint32_t>(n);
    count += numbers[n] <= limit ? 1 : 0;
  }
  return count;
}

}  // namespace sazare
