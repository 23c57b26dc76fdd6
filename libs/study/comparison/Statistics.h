/// @file Statistics.h
/// @brief What a table over seeds is summarised by: quantiles, a rate's interval, paired tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hybrid_slam::comparison {

/// The p-quantile, p in [0, 1], interpolated linearly between the order statistics (Hyndman & Fan's type 7,
/// the default of R and NumPy).
/// @param values  at least one
double quantile(std::vector<double> values, double p);

struct Quartiles {
  double lower = 0, median = 0, upper = 0;
};
Quartiles quartiles(const std::vector<double>& values);

/// [low, high], both ends included.
struct Interval {
  double low = 0, high = 0;
};

/// 95 % interval of a rate by Wilson's score (1927); [0, 1] for no trial.
Interval wilsonInterval(size_t successes, size_t trials);

/// Two-sided p of Wilcoxon's signed-rank test (1945) on paired differences: exact, over all signs of the
/// ranks that were seen, so that ties are no approximation; equal magnitudes share their mean rank, zeros are
/// left out. 1 where nothing is left. Takes time in the third power of the number of differences.
double wilcoxonSignedRank(const std::vector<double>& differences);

/// Two-sided exact p of the sign test (for differences of 0/1 outcomes: McNemar's exact test); zeros are left
/// out, 1 where nothing is left.
double signTest(const std::vector<double>& differences);

/// median(a) / median(b) of paired samples.
struct MedianRatio {
  double ratio = 1;
  Interval interval;  ///< 95 %, by the percentile bootstrap over pairs
};

/// @param a,b   of equal length; a[i] and b[i] belong together
/// @param seed  of the bootstrap's random numbers: same seed, same interval
/// @returns nothing for no pair, or where a median to divide by is 0 in the sample or in a resample
std::optional<MedianRatio> medianRatio(const std::vector<double>& a, const std::vector<double>& b,
                                       uint64_t seed);

}  // namespace hybrid_slam::comparison
