#include "reports/plots/plot.hpp"

namespace tvbeam {

std::vector<Plot> plots_of(const StudyResult& result) {
    std::vector<Plot> all;
    for (const auto& plots : {convergence_plots, error_surface_plots, run_time_plots,
                              evolution_plots, stress_plots, contraction_plots, round_off_plots})
        for (auto& plot : plots(result))
            all.push_back(std::move(plot));
    return all;
}

} // namespace tvbeam
