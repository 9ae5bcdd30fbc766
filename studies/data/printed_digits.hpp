/// How finely the numbers of a column were printed.
#pragma once

#include <string_view>
#include <vector>

namespace tvbeam {

/// What the text of a number shows beside its value.
struct PrintedDigits {
    int significant = 0; ///< from the first that is not zero; of 0.00: none
    int last_place = 0;  ///< the last digit counts 10^last_place
    /// 0 or 0.00e+00, of a number that is zero; 0.00 may be 0.004.
    bool is_zero = false;
};

/// Of the text of a number, also one with a decimal comma or Fortran's exponent. A text without
/// digits has none.
PrintedDigits printed_digits(std::string_view text);

/// The unit of the last digit of each number of a column; none where a number has so many digits
/// that it is a double as it was, and all are taken for such. Programs that leave out trailing
/// zeros print some numbers with fewer digits than they have: the number with the most digits, and
/// that with the last place furthest right, speak for all. NaN has the latter's.
std::vector<double> printed_units(const std::vector<double>& numbers,
                                  const std::vector<PrintedDigits>& digits);

/// The same of errors: one of 0 is of a solution that is met, and has 0; a value of 0 may be what
/// is left of 0.0003.
std::vector<double> printed_units_of_errors(const std::vector<double>& errors,
                                            const std::vector<PrintedDigits>& digits);

/// The same of widths. They were rounded where the ratios of most to the next finer one are no
/// fractions with denominators up to 12, or all ratios are those of a refinement to the digits
/// printed and not all fractions of two numbers up to 12: 0.33, 0.17 and 0.08 were; 0.1, 0.05 and
/// 0.025, or 0.15, 0.1 and 0.06, were not, nor whole numbers.
std::vector<double> printed_units_of_widths(const std::vector<double>& widths,
                                            const std::vector<PrintedDigits>& digits);

/// Standard deviations of errors that were rounded to these units; none without them, and where
/// half of the errors are known so well that an order between two levels, whose widths have this
/// ratio, shows it by 0.001 at most: on halved widths, to four digits; of grids, where a term is
/// what the others leave of an error, to five. No error is known better than half of them are: what
/// a model leaves out is no smaller in one that has more digits.
std::vector<double> deviations_of_rounding(const std::vector<double>& errors,
                                           const std::vector<double>& units, double level_ratio,
                                           bool is_grid);

/// The mean ratio of one level to the next finer, widths within an eighth being one; infinity where
/// there is one level alone.
double level_ratio(std::vector<double> widths);

} // namespace tvbeam
