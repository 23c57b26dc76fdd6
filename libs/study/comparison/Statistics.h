/// @file Statistics.h
/// @brief Statistics over seeds: quantiles, interval of a rate, paired tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hybrid_slam::comparison {

/// The p-quantile, p in [0, 1], interpolated linearly between the order statistics (Hyndman & Fan's type 7,
/// the default of R and NumPy).
/// @param values  at least one
double interpolatedQuantile(std::vector<double> values, double p);

/// The median, and the quartiles around it.
struct Quartiles {
  double lower = 0, median = 0, upper = 0;
};
/// Interpolates linearly between order statistics (type 7 of Hyndman and Fan).
Quartiles quartiles(const std::vector<double>& values);

/// [low, high], both ends included.
struct Interval {
  double low = 0, high = 0;
};

/// 95 % Wilson score interval of a rate (1927); [0, 1] without trials.
Interval wilsonInterval(size_t successes, size_t trials);

/// Two-sided p of Wilcoxon's signed-rank test (1945) on paired differences: exact over all signs of the
/// observed ranks, also with ties. Equal magnitudes share their mean rank; zeros are dropped. 1 if no
/// difference remains. Time is cubic in the number of differences.
double wilcoxonSignedRank(const std::vector<double>& differences);

/// Two-sided exact p of the sign test (for differences of 0/1 outcomes: McNemar's exact test); zeros are
/// dropped; 1 if no difference remains.
double signTest(const std::vector<double>& differences);

/// median(a) / median(b) of paired samples.
struct MedianRatio {
  double ratio = 1;
  Interval interval;  ///< 95 %, by the percentile bootstrap over pairs
};

/// @param a,b   of equal length; a[i] and b[i] are paired
/// @param seed  bootstrap seed; same seed, same interval
/// @returns empty without pairs, or if the median of b is 0 in the sample or a resample
std::optional<MedianRatio> medianRatio(const std::vector<double>& a, const std::vector<double>& b,
                                       uint64_t seed);

}  // namespace hybrid_slam::comparison
