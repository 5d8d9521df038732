#include "bench/world/dust_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "bench/world/dust_files.h"
#include "bench/world/time_step.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::world {
namespace {

using Store = particles::ParticleStore;

std::string columnsOf(const DustMoment& moment) {
    std::string names = "position, radius, opacity";
    for (const auto& [has, name] :
         {std::pair{moment.hasIds, "id"}, std::pair{moment.hasVelocity, "velocity"}, std::pair{moment.hasAge, "age"},
          std::pair{moment.hasLifetime, "lifetime"}, std::pair{moment.hasColour, "colour"}})
        if (has) names += std::string(", ") + name;
    return names;
}

void requireSeries(const std::vector<DustMoment>& moments) {
    if (moments.empty()) throw InputError("dust: got no moments, expected one or more");
    for (std::size_t i = 0; i < moments.size() && moments.size() > 1; ++i) {
        const DustMoment& moment = moments[i];
        if (!moment.timeSeconds)
            throw InputError(
                moment.file +
                ": has no time, expected TimeValue (.vtp), time_s (.vdb), or a .pvd or .series with times");
        if (i == 0) continue;
        const DustMoment& before = moments[i - 1];
        if (!(*moment.timeSeconds > *before.timeSeconds))
            throw InputError(fmt::format("{}: its time is {} s, expected more than {} s, the time of {}", moment.file,
                                         *moment.timeSeconds, *before.timeSeconds, before.file));
        if (const std::string has = columnsOf(moment), expected = columnsOf(before); has != expected)
            throw InputError(fmt::format("{}: has {}, expected {} as in {}", moment.file, has, expected, before.file));
        if (!moment.hasIds && moment.size() != before.size())
            throw InputError(fmt::format("{}: has {} particles, expected {} as in {}, because there are no ids",
                                         moment.file, moment.size(), before.size(), before.file));
    }
}

}  // namespace

DustSeries DustSeries::read(const std::filesystem::path& path, const std::string& columns) {
    try {
        DustFiles read = readDustFiles(path, DustColumns::parse(columns), !columns.empty());
        DustSeries series(std::move(read.moments));
        series.files_ = std::move(read.files);
        series.albedo_ = read.albedo;
        return series;
    } catch (const InputError& error) {
        throw InputError(files::printable(error.what()));  // names within the files may contain any bytes
    }
}

DustSeries::DustSeries(std::vector<DustMoment> moments) : moments_(std::move(moments)) {
    requireSeries(moments_);
    match();
    fillAges();
}

void DustSeries::match() {
    std::unordered_map<std::uint64_t, std::uint32_t> places;
    for (std::size_t m = 0; m < moments_.size(); ++m) {
        DustMoment& moment = moments_[m];
        moment.next.assign(moment.size(), DustMoment::none);
        if (m + 1 == moments_.size()) break;
        const DustMoment& after = moments_[m + 1];
        places.clear();
        for (std::size_t i = 0; i < after.size(); ++i) places.emplace(after.id[i], static_cast<std::uint32_t>(i));
        std::size_t both = 0;
        for (std::size_t i = 0; i < moment.size(); ++i)
            if (const auto found = places.find(moment.id[i]); found != places.end()) {
                moment.next[i] = found->second;
                ++both;
            }
        births_ += after.size() - both;
        deaths_ += moment.size() - both;
    }
}

/// Without ages, the age of a particle is the time since its first moment; without lifetimes, all live as long as the
/// oldest.
void DustSeries::fillAges() {
    float oldest = static_cast<float>(stepSeconds);
    for (std::size_t m = 0; m < moments_.size(); ++m) {
        DustMoment& moment = moments_[m];
        if (!moment.hasAge) {
            moment.age.resize(moment.size(), 0.0f);
            if (m > 0) {
                const DustMoment& before = moments_[m - 1];
                const auto passed = static_cast<float>(*moment.timeSeconds - *before.timeSeconds);
                for (std::size_t i = 0; i < before.size(); ++i)
                    if (before.next[i] != DustMoment::none) moment.age[before.next[i]] = before.age[i] + passed;
            }
        }
        for (const float age : moment.age) oldest = std::max(oldest, age);
    }
    for (DustMoment& moment : moments_) {
        if (!moment.hasLifetime) moment.lifetime.assign(moment.size(), oldest);
        if (!moment.hasVelocity)
            for (auto* column : {&moment.velocityX, &moment.velocityY, &moment.velocityZ})
                column->assign(moment.size(), 0.0f);
    }
    if (moments_.front().hasVelocity) return;
    for (std::size_t m = 0; m + 1 < moments_.size(); ++m) {
        DustMoment &from = moments_[m], &to = moments_[m + 1];
        const auto span = static_cast<float>(*to.timeSeconds - *from.timeSeconds);
        for (std::size_t i = 0; i < from.size(); ++i) {
            const std::uint32_t j = from.next[i];
            if (j == DustMoment::none) continue;
            from.velocityX[i] = to.velocityX[j] = (to.x[j] - from.x[i]) / span;
            from.velocityY[i] = to.velocityY[j] = (to.y[j] - from.y[i]) / span;
            from.velocityZ[i] = to.velocityZ[j] = (to.z[j] - from.z[i]) / span;
        }
    }
}

std::size_t DustSeries::bytes() const {
    std::size_t bytes = 0;
    for (const DustMoment& m : moments_) {
        bytes += m.id.size() * sizeof(std::uint64_t) + m.next.size() * sizeof(std::uint32_t);
        for (const auto* column : {&m.x, &m.y, &m.z, &m.velocityX, &m.velocityY, &m.velocityZ, &m.age, &m.lifetime,
                                   &m.radius, &m.opacity, &m.red, &m.green, &m.blue})
            bytes += column->size() * sizeof(float);
    }
    return bytes;
}

double DustSeries::seconds() const {
    return isStill() ? 0 : *moments_.back().timeSeconds - *moments_.front().timeSeconds;
}

void DustSeries::show(double seconds, Store& store) const {
    std::size_t at = 0;
    if (!isStill()) {
        const double first = *moments_.front().timeSeconds;
        const auto after = std::ranges::upper_bound(moments_, first + seconds + sameMomentSeconds, {},
                                                    [](const DustMoment& moment) { return *moment.timeSeconds; });
        at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - moments_.begin() - 1, 0));
    }
    const DustMoment& from = moments_[at];
    const DustMoment* const to = at + 1 < moments_.size() ? &moments_[at + 1] : nullptr;
    const double passed = to ? *moments_.front().timeSeconds + seconds - *from.timeSeconds : 0;
    const bool between = passed > sameMomentSeconds;
    const auto share = between ? static_cast<float>(passed / (*to->timeSeconds - *from.timeSeconds)) : 0.0f;
    const auto elapsed = static_cast<float>(between ? passed : 0);

    store.keepOneColour(!from.hasColour);
    store.resize(from.size());
    std::ranges::copy(from.id, store.serial.begin());
    const auto blend = [&](const std::vector<float>& begin, const std::vector<float> DustMoment::*column, auto&& alone,
                           auto& target) {
        std::ranges::copy(begin, target.begin());
        if (!between) return;
        for (std::size_t i = 0; i < from.size(); ++i)
            target[i] = from.next[i] == DustMoment::none ? alone(i)
                                                         : begin[i] + share * ((to->*column)[from.next[i]] - begin[i]);
    };
    const auto moved = [&](const std::vector<float>& place, const std::vector<float>& velocity) {
        return [&place, &velocity, elapsed](std::size_t i) { return place[i] + velocity[i] * elapsed; };
    };
    const auto stays = [](const std::vector<float>& values) { return [&values](std::size_t i) { return values[i]; }; };
    blend(from.x, &DustMoment::x, moved(from.x, from.velocityX), store.x);
    blend(from.y, &DustMoment::y, moved(from.y, from.velocityY), store.y);
    blend(from.z, &DustMoment::z, moved(from.z, from.velocityZ), store.z);
    blend(from.velocityX, &DustMoment::velocityX, stays(from.velocityX), store.velocityX);
    blend(from.velocityY, &DustMoment::velocityY, stays(from.velocityY), store.velocityY);
    blend(from.velocityZ, &DustMoment::velocityZ, stays(from.velocityZ), store.velocityZ);
    blend(
        from.age, &DustMoment::age, [&](std::size_t i) { return from.age[i] + elapsed; }, store.age);
    blend(from.lifetime, &DustMoment::lifetime, stays(from.lifetime), store.lifetime);
    blend(from.radius, &DustMoment::radius, stays(from.radius), store.radius);
    blend(from.opacity, &DustMoment::opacity, stays(from.opacity), store.opacity);
    if (from.depthsChange && between)
        for (std::size_t i = 0; i < from.size(); ++i)
            if (from.next[i] != DustMoment::none)
                store.opacity[i] = -std::expm1((1 - share) * std::log1p(-from.opacity[i]) +
                                               share * std::log1p(-to->opacity[from.next[i]]));
    if (!from.hasColour) return;
    blend(from.red, &DustMoment::red, stays(from.red), store.red);
    blend(from.green, &DustMoment::green, stays(from.green), store.green);
    blend(from.blue, &DustMoment::blue, stays(from.blue), store.blue);
}

}  // namespace dustbench::world
