#include "studies/runs/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <numeric>
#include <thread>

namespace tvbeam {

std::vector<std::size_t> longest_first(const std::vector<double>& costs) {
    std::vector<std::size_t> order(costs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
    return order;
}

void for_each_longest_first(const std::vector<double>& costs, int jobs,
                            const std::function<void(std::size_t)>& work) {
    const auto order =
        longest_first(jobs > 1 ? costs : std::vector<double>(costs.size(), 1.0)); // stable
    std::vector<std::exception_ptr> thrown(order.size());
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> stop = false;
    // All that stand before one that was begun were begun too, so the first exception in order is
    // always found.
    const auto take_until_none_is_left = [&] {
        while (!stop) {
            const std::size_t at = next++;
            if (at >= order.size())
                return;
            try {
                work(order[at]);
            } catch (...) {
                thrown[at] = std::current_exception();
                stop = true;
            }
        }
    };
    {
        const auto most = std::min(static_cast<std::size_t>(jobs), order.size());
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < most; ++i)
            others.emplace_back(take_until_none_is_left);
        take_until_none_is_left();
    }
    for (const auto& exception : thrown)
        if (exception)
            std::rethrow_exception(exception);
}

} // namespace tvbeam
