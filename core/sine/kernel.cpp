#include "core/sine/kernel.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

using Index = std::int64_t;

/// A vector register of so many bytes. Wider ones than the processor has would be taken apart in
/// memory.
template <Index bytes>
struct Register;
template <>
struct Register<64> {
    using Lanes [[gnu::vector_size(64), gnu::may_alias]] = double;
};
template <>
struct Register<32> {
    using Lanes [[gnu::vector_size(32), gnu::may_alias]] = double;
};
template <>
struct Register<16> {
    using Lanes [[gnu::vector_size(16), gnu::may_alias]] = double;
};

constexpr Index registers = 4; ///< of one Modes

/// Modes of one group, in registers: all of them where those are wide, else a part.
template <Index bytes>
struct Modes {
    using Lanes = typename Register<bytes>::Lanes;
    Lanes packs[registers] = {};

    Modes() = default;

    [[gnu::always_inline]] explicit Modes(const double* from) {
        for (Index v = 0; v < registers; ++v)
            packs[v] = reinterpret_cast<const Lanes*>(from)[v];
    }
    [[gnu::always_inline]] void store(double* to) const {
        for (Index v = 0; v < registers; ++v)
            reinterpret_cast<Lanes*>(to)[v] = packs[v];
    }
    [[gnu::always_inline]] Modes& operator+=(const Modes& other) {
        for (Index v = 0; v < registers; ++v)
            packs[v] += other.packs[v];
        return *this;
    }
    [[gnu::always_inline]] Modes& operator-=(const Modes& other) {
        for (Index v = 0; v < registers; ++v)
            packs[v] -= other.packs[v];
        return *this;
    }
    [[gnu::always_inline]] Modes& operator*=(const Modes& other) {
        for (Index v = 0; v < registers; ++v)
            packs[v] *= other.packs[v];
        return *this;
    }
    [[gnu::always_inline]] Modes& operator*=(double factor) {
        for (auto& pack : packs)
            pack *= factor;
        return *this;
    }
    [[gnu::always_inline]] friend Modes operator+(const Modes& left, const Modes& right) {
        Modes result = left;
        return result += right;
    }
    [[gnu::always_inline]] friend Modes operator-(const Modes& left, const Modes& right) {
        Modes result = left;
        return result -= right;
    }
    [[gnu::always_inline]] friend Modes operator*(const Modes& left, const Modes& right) {
        Modes result = left;
        return result *= right;
    }
    [[gnu::always_inline]] friend Modes operator*(double factor, const Modes& right) {
        Modes result = right;
        return result *= factor;
    }
    /// Adds all to the lanes of one pack.
    [[gnu::always_inline]] void add_to(Pack& sum) const {
        constexpr Index in_pack = static_cast<Index>(sizeof(Pack)) / bytes;
        for (Index part = 0; part < in_pack; ++part) {
            Lanes total = packs[part];
            for (Index v = part + in_pack; v < registers; v += in_pack)
                total += packs[v];
            reinterpret_cast<Lanes*>(&sum)[part] += total;
        }
    }
};

/// Where arrays of modes are read: so many doubles behind their begin. A table without columns may
/// be null.
[[gnu::always_inline]] inline const double* at(const Pack* array, Index place) {
    return array == nullptr ? nullptr : array->lanes + place;
}

/// value + Σ_j weights_j T_j over the columns first … last − 1.
template <typename M>
[[gnu::always_inline]] inline M combined(const M& value, const double* table, Index stride,
                                         const double* weights, Index weight_stride, Index first,
                                         Index last) {
    M sum = value;
    for (Index j = first; j < last; ++j)
        sum += weights[j * weight_stride] * M(table + j * stride);
    return sum;
}

/// θ and a of one group with their increments.
template <typename M, Index increments>
struct State {
    static constexpr Index kept = increments > 0 ? increments : Index{1};
    M theta;
    M bend;
    M theta_increments[kept];
    M bend_increments[kept];
};

template <bool coupled, typename M, Index increments>
[[gnu::always_inline]] inline void load(State<M, increments>& state, const double* from,
                                        Index stride) {
    constexpr Index fields = coupled ? 2 : 1;
    state.theta = M(from);
    if constexpr (coupled)
        state.bend = M(from + stride);
    for (Index e = 0; e < increments; ++e) {
        from += fields * stride;
        state.theta_increments[e] = M(from);
        if constexpr (coupled)
            state.bend_increments[e] = M(from + stride);
    }
}

template <bool coupled, typename M, Index increments>
[[gnu::always_inline]] inline void store(const State<M, increments>& state, double* to,
                                         Index stride) {
    constexpr Index fields = coupled ? 2 : 1;
    state.theta.store(to);
    if constexpr (coupled)
        state.bend.store(to + stride);
    for (Index e = 0; e < increments; ++e) {
        to += fields * stride;
        state.theta_increments[e].store(to);
        if constexpr (coupled)
            state.bend_increments[e].store(to + stride);
    }
}

/// Makes increment e the difference of (theta, bend) and the state at the step's begin.
template <bool coupled, typename M, Index increments>
[[gnu::always_inline]] inline void remember(State<M, increments>& state, Index e, const M& theta,
                                            const M& bend) {
    for (Index at = 0; at < increments; ++at)
        if (at == e) {
            state.theta_increments[at] = theta - state.theta;
            if constexpr (coupled)
                state.bend_increments[at] = bend - state.bend;
        }
}

/// What a group, or a part of it, reads in every step.
template <typename M>
struct Group {
    Index index;
    Index place; ///< in doubles
    Index stride;
    const double* table;
    Index columns;
    M stiffness;
    M inverse;
};

/// One solve: θ*, a* become θ, a.
template <bool coupled, typename M>
[[gnu::always_inline]] inline void solve(const SineBlock& block, const Group<M>& group, Index at,
                                         M& theta, M& bend) {
    // The loads first: they wait for nothing, while the state of one step waits for that of the
    // step before.
    M rest = combined(M{}, group.table, group.stride, block.loads + at, block.load_stride, 0,
                      group.columns);
    rest -= group.stiffness * theta;
    M balance;
    if constexpr (coupled) {
        balance = bend + block.alpha * theta;
        rest -= block.exchange * balance;
    }
    const M change = rest * group.inverse;
    theta += change;
    if constexpr (coupled) {
        bend -= block.kappa * (balance + block.alpha * change);
        if (block.tip != nullptr)
            (bend * M(group.table)).add_to(block.tip[at]);
    }
}

/// Adds the squares of the errors in the modes z of one group after a step.
template <typename M>
[[gnu::always_inline]] inline void add_squares(std::span<const SineSquare> squares,
                                               const Group<M>& group, Index step, const M& z) {
    for (const SineSquare& square : squares) {
        const M error =
            combined(z, at(square.table, group.place), group.stride, square.weights + step,
                     square.weight_stride, square.first_column, square.active_columns[group.index]);
        if (square.factors == nullptr)
            (error * error).add_to(square.squares[step]);
        else
            (error * error * M(at(square.factors, group.place))).add_to(square.squares[step]);
        if (square.arm != nullptr)
            (error * M(at(square.arm, group.place))).add_to(square.moments[step]);
    }
}

template <Index increments, bool coupled, typename M>
[[gnu::always_inline]] inline void march_group(const SineBlock& block, Index index, Index place) {
    const Index stride = block.stride * Pack::size;
    const Group<M> group{index,
                         place,
                         stride,
                         at(block.table, place),
                         block.active_columns[index],
                         M(at(block.stiffness, place)),
                         M(at(block.inverse, place))};
    State<M, increments> state;
    load<coupled>(state, at(block.before, place), stride);

    for (Index step = 0; step < block.steps; ++step) {
        M theta = state.theta;
        M bend = state.bend;
        for (Index stage = 0; stage < block.stages; ++stage) {
            if (increments > 0 && stage > 0) {
                theta = state.theta;
                bend = state.bend;
            }
            for (Index e = 0; e < increments; ++e) {
                const double weight = block.increment_weights[stage * increments + e];
                theta += weight * state.theta_increments[e];
                if constexpr (coupled)
                    bend += weight * state.bend_increments[e];
            }
            solve<coupled>(block, group, step * block.stages + stage, theta, bend);
            if (increments > 0 && stage + 1 < block.stages)
                remember<coupled>(state, block.history + stage, theta, bend);
        }
        if (increments > 0 && block.history > 0) {
            for (Index e = increments - 1; e > 0; --e)
                if (e < block.history) {
                    state.theta_increments[e] = state.theta_increments[e - 1];
                    state.bend_increments[e] = state.bend_increments[e - 1];
                }
            remember<coupled>(state, 0, theta, bend);
        }
        state.theta = theta;
        if constexpr (coupled)
            state.bend = bend;
        add_squares(block.of_temperature, group, step, theta);
        if constexpr (coupled)
            add_squares(block.of_curvature, group, step, bend);
    }
    if (block.after != nullptr) {
        store<coupled>(state, block.after->lanes + place, stride);
        state.theta.add_to(*block.sum);
    }
}

template <Index increments, bool coupled, typename M>
[[gnu::always_inline]] inline void march_all(const SineBlock& block) {
    constexpr Index all = packs_in_group * Pack::size;
    constexpr Index part =
        registers * static_cast<Index>(sizeof(typename M::Lanes) / sizeof(double));
    for (Index group = 0; group < block.groups; ++group)
        for (Index within = 0; within < all; within += part)
            march_group<increments, coupled, M>(block, group, group * all + within);
}

/// While it lives, what is smaller than any normal number counts as zero: a mode that has decayed
/// so far would cost a hundred times what another does.
#ifdef __x86_64__
class FlushToZero {
public:
    FlushToZero() : before_(__builtin_ia32_stmxcsr()) {
        __builtin_ia32_ldmxcsr(before_ | flush_results | flush_operands);
    }
    ~FlushToZero() { __builtin_ia32_ldmxcsr(before_); }
    FlushToZero(const FlushToZero&) = delete;
    FlushToZero& operator=(const FlushToZero&) = delete;
    FlushToZero(FlushToZero&&) = delete;
    FlushToZero& operator=(FlushToZero&&) = delete;

private:
    static constexpr unsigned flush_results = 1U << 15U;
    static constexpr unsigned flush_operands = 1U << 6U;
    unsigned before_;
};
#else
struct FlushToZero {
    FlushToZero() {} // such modes cost time elsewhere, and are right
};
#endif

template <typename M>
[[gnu::always_inline]] inline void march_with(const SineBlock& block) {
    switch (2 * block.increments + (block.coupled ? 1 : 0)) {
    case 0:
        return march_all<0, false, M>(block);
    case 1:
        return march_all<0, true, M>(block);
    case 2:
        return march_all<1, false, M>(block);
    case 3:
        return march_all<1, true, M>(block);
    case 4:
        return march_all<2, false, M>(block);
    default:
        return march_all<2, true, M>(block);
    }
}

// What is inlined is compiled for the units that the function is for. clang 14 cannot ask for
// levels.
#if defined(__x86_64__) && !defined(__clang__)
[[gnu::target("arch=x86-64-v4")]] void march_v4(const SineBlock& block) {
    march_with<Modes<64>>(block);
}
[[gnu::target("arch=x86-64-v3")]] void march_v3(const SineBlock& block) {
    march_with<Modes<32>>(block);
}
#endif
void march_anywhere(const SineBlock& block) {
    march_with<Modes<16>>(block);
}

} // namespace

std::span<const SineKernel> sine_kernels() {
    static const SineKernel kernels[] = {
#if defined(__x86_64__) && !defined(__clang__)
        {"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0, &march_v4},
        {"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0, &march_v3},
#endif
        {"any", true, &march_anywhere},
    };
    return kernels;
}

const SineKernel& chosen_sine_kernel() {
    static const SineKernel& chosen =
        *std::find_if(sine_kernels().begin(), sine_kernels().end(),
                      [](const SineKernel& kernel) { return kernel.runs_here; });
    return chosen;
}

void march(const SineBlock& block) {
    const FlushToZero flush;
    chosen_sine_kernel().march(block);
}

} // namespace tvbeam
