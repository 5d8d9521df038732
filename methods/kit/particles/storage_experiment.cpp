#include "methods/kit/particles/storage_experiment.h"

#include <malloc.h>

#include <algorithm>
#include <forward_list>
#include <map>
#include <memory_resource>
#include <unordered_map>

#include "methods/kit/findings/findings.h"
#include "methods/kit/findings/timing.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::particles::storage {
namespace {

using findings::medianOf, findings::secondsOf;

constexpr float seconds = 1.0f / 60, meanLifetime = 200 * seconds;
constexpr int warmUpSteps = 400, timedSteps = 20;

/// Newborns whose lifetimes vary by half the mean, so that the dead are scattered.
class Births {
 public:
    Births(std::uint64_t seed, std::size_t perStep) : seed_(seed), newborns_(perStep) {}

    const std::vector<Attributes>& next() {
        for (Attributes& newborn : newborns_) {
            const auto u = maths::uniform4(seed_, 1, serial_++);
            newborn = {};
            newborn.velocity = {u[0], u[1], u[2]};
            newborn.acceleration = {0, -9.8f, 0};
            newborn.lifetime = meanLifetime * (0.5f + u[3]);
        }
        return newborns_;
    }

 private:
    std::uint64_t seed_, serial_ = 0;
    std::vector<Attributes> newborns_;
};

/// Nanoseconds per particle and step.
struct Times {
    std::vector<double> scan, churn, refill;
};

template <typename Storage>
class Subject {
 public:
    Subject(std::uint64_t seed, std::size_t particles) : particles_(particles), births_(seed, particles / 200) {
        for (int i = 0; i < warmUpSteps; ++i) {
            storage_.scan(seconds);
            storage_.churn(births_.next());
        }
    }
    void measure(Times& times) {
        double scan = 0, churn = 0, refill = 0;
        for (int i = 0; i < timedSteps; ++i) {
            scan += secondsOf([&] { storage_.scan(seconds); });
            const auto& newborns = births_.next();
            if constexpr (requires { storage_.sweep(); }) {
                churn += secondsOf([&] { storage_.sweep(); });
                const double spent = secondsOf([&] { storage_.refill(newborns); });
                refill += spent;
                churn += spent;
            } else {
                churn += secondsOf([&] { storage_.churn(newborns); });
            }
        }
        const double perParticle = 1e9 / timedSteps / static_cast<double>(particles_);
        times.scan.push_back(scan * perParticle);
        times.churn.push_back(churn * perParticle);
        times.refill.push_back(refill * perParticle);
    }

 private:
    std::size_t particles_;
    Births births_;
    Storage storage_;
};

/// Returns the ratio of two series that were measured alternately.
Finding ratioOf(std::string quantity, const std::vector<double>& above, const std::vector<double>& below) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < above.size(); ++i) ratios.push_back(above[i] / below[i]);
    return medianOf(std::move(quantity), ratios);
}

/// Seconds in which a storage grows from nothing to `particles`, in `steps` steps. Freed memory is first returned to
/// the system, so that all storages grow into new memory, like a system that has never been so large.
template <typename Add>
double growthSeconds(std::uint64_t seed, std::size_t particles, int steps, const Add& add) {
    Births births(seed, particles / static_cast<std::size_t>(steps));
    double total = 0;
    malloc_trim(0);
    for (int step = 0; step < steps; ++step) {
        const auto& newborns = births.next();
        total += secondsOf([&] { add(newborns); });
    }
    return total;
}

/// For a list of newly allocated nodes, an array that doubles its capacity, and one without spare capacity.
void measureGrowth(std::uint64_t seed, std::size_t particles, int repetitions, std::vector<Finding>& findings) {
    constexpr int steps = 200;
    std::vector<double> list, listAgain, doubling, tight;
    const auto growList = [&] {
        List<false> storage;
        return growthSeconds(seed, particles, steps, [&](const auto& newborns) { storage.refill(newborns); });
    };
    for (int k = 0; k < repetitions; ++k) {
        list.push_back(growList());
        listAgain.push_back(growList());
        ArrayOfStructures<false> array;
        doubling.push_back(
            growthSeconds(seed, particles, steps, [&](const auto& newborns) { array.append(newborns); }));
        TightArray moved;
        tight.push_back(growthSeconds(seed, particles, steps, [&](const auto& newborns) { moved.add(newborns); }));
    }
    findings.push_back(ratioOf("growth_array_over_list", doubling, list));
    findings.push_back(ratioOf("growth_moved_array_over_list", tight, list));
    findings.push_back(ratioOf("growth_of_equals", listAgain, list));
}

/// With fewer particles: erasing each dead particle from an array separately takes time by the square of their number.
void measureErasure(std::uint64_t seed, std::size_t particles, int repetitions, std::vector<Finding>& findings) {
    Subject<List<true>> list(seed, particles);
    Subject<ErasedArray> erased(seed, particles);
    Times ofList, ofErased;
    for (int k = 0; k < repetitions; ++k) {
        list.measure(ofList);
        erased.measure(ofErased);
    }
    findings.push_back(ratioOf("churn_erased_array_over_list", ofErased.churn, ofList.churn));
}

using HashTable = Keyed<std::unordered_map<std::uint64_t, Attributes>>;
using Tree = Keyed<std::map<std::uint64_t, Attributes>>;

/// Counts the bytes that are allocated.
class CountedMemory final : public std::pmr::memory_resource {
 public:
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override {
        bytes_ += bytes;
        return std::pmr::new_delete_resource()->allocate(bytes, alignment);
    }
    void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
        bytes_ -= bytes;
        std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
    }
    [[nodiscard]] bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override {
        return this == &other;
    }

    std::size_t bytes_ = 0;
};

/// Bytes per particle of a container over those of the list.
template <template <typename, typename> typename Container>
Finding bytesOverList(std::string quantity, std::size_t particles) {
    CountedMemory memory;
    Keyed<Container<std::uint64_t, Attributes>> storage(&memory);
    storage.churn(std::vector<Attributes>(particles));
    const double ratio = static_cast<double>(memory.bytes()) / static_cast<double>(particles) /
                         static_cast<double>(List<true>::bytesPerParticle());
    return {std::move(quantity), ratio, ratio, ratio, static_cast<std::int64_t>(particles)};
}

template <typename Key, typename Value>
using CountedTable = std::pmr::unordered_map<Key, Value>;
template <typename Key, typename Value>
using CountedTree = std::pmr::map<Key, Value>;

/// The containers that the thesis leaves out, over a list that has no pool either. How fast each is depends on the
/// memory that its nodes happen to get, so all are made nine times, and each time gives one ratio.
void measureKeyed(std::uint64_t seed, std::size_t particles, std::vector<Finding>& findings) {
    constexpr std::uint64_t makes = 9;
    std::vector<double> ofList, ofTable, ofTree;
    const auto scanOf = [&](auto& subject) {
        Times times;
        for (int k = 0; k < 3; ++k) subject.measure(times);
        return std::ranges::min(times.scan);
    };
    for (std::uint64_t make = 0; make < makes; ++make) {
        Subject<List<false>> list(seed + make, particles);
        Subject<HashTable> table(seed + make, particles);
        Subject<Tree> tree(seed + make, particles);
        ofList.push_back(scanOf(list));
        ofTable.push_back(scanOf(table));
        ofTree.push_back(scanOf(tree));
    }
    findings.push_back(ratioOf("scan_hash_over_list", ofTable, ofList));
    findings.push_back(ratioOf("scan_tree_over_list", ofTree, ofList));
    findings.push_back(bytesOverList<CountedTable>("bytes_hash_over_list", particles));
    findings.push_back(bytesOverList<CountedTree>("bytes_tree_over_list", particles));
    CountedMemory memory;
    const std::pmr::forward_list<Attributes> standardList(particles, Attributes{}, &memory);
    const double bytes = static_cast<double>(memory.bytes()) / static_cast<double>(particles) /
                         static_cast<double>(List<true>::bytesPerParticle());
    findings.push_back({"bytes_list_over_list", bytes, bytes, bytes, 1});
}

}  // namespace

std::vector<Finding> measureStorage(std::uint64_t seed, std::size_t particles, int repetitions) {
    Subject<List<false>> list(seed, particles);
    Subject<List<true>> listPool(seed, particles);
    Subject<ArrayOfStructures<false>> aos(seed, particles);
    Subject<ArrayOfStructures<true>> aosPool(seed, particles);
    Subject<StructureOfArrays<false>> soa(seed, particles);
    Subject<StructureOfArrays<true>> soaPool(seed, particles);
    std::map<std::string, Times> times;
    Times listPoolAgain, aosPoolAgain;
    for (int k = 0; k < repetitions; ++k) {
        list.measure(times["list"]);
        listPool.measure(times["list_pool"]);
        listPool.measure(listPoolAgain);
        aos.measure(times["aos"]);
        aosPool.measure(times["aos_pool"]);
        aosPool.measure(aosPoolAgain);
        soa.measure(times["soa"]);
        soaPool.measure(times["soa_pool"]);
    }
    std::vector<Finding> findings{ratioOf("scan_list_over_soa", times["list_pool"].scan, times["soa_pool"].scan),
                                  ratioOf("scan_aos_over_soa", times["aos_pool"].scan, times["soa_pool"].scan),
                                  ratioOf("scan_list_over_aos", times["list_pool"].scan, times["aos_pool"].scan)};
    for (const std::string name : {"list", "aos", "soa"})
        findings.push_back(ratioOf("churn_without_over_with_" + name, times[name].churn, times[name + "_pool"].churn));
    findings.push_back(ratioOf("allocation_without_over_with_list", times["list"].refill, times["list_pool"].refill));
    findings.push_back(ratioOf("allocation_of_equals", listPoolAgain.refill, times["list_pool"].refill));
    findings.push_back(ratioOf("scan_of_equals", aosPoolAgain.scan, times["aos_pool"].scan));
    findings.push_back(ratioOf("churn_aos_over_list", times["aos_pool"].churn, times["list_pool"].churn));
    findings.push_back(ratioOf("churn_of_equals", listPoolAgain.churn, times["list_pool"].churn));
    std::vector<double> twice;
    for (std::size_t i = 0; i < aosPoolAgain.scan.size(); ++i)
        twice.push_back((times["aos_pool"].scan[i] + aosPoolAgain.scan[i]) / times["aos_pool"].scan[i]);
    findings.push_back(medianOf("scan_twice", twice));
    const double bytes = static_cast<double>(List<true>::bytesPerParticle()) / sizeof(Attributes);
    constexpr double bytesOfPlace = 3 * sizeof(float), bytesOfLinkedPlace = bytesOfPlace + 4 + sizeof(void*);
    findings.push_back({"bytes_list_over_array", bytes, bytes, bytes, 1});
    findings.push_back({"bytes_list_over_array_of_places", bytesOfLinkedPlace / bytesOfPlace,
                        bytesOfLinkedPlace / bytesOfPlace, bytesOfLinkedPlace / bytesOfPlace, 1});
    measureGrowth(seed, particles, std::min(repetitions, 9), findings);
    measureErasure(seed, particles / 10, std::min(repetitions, 9), findings);
    measureKeyed(seed, particles / 4, findings);
    for (const auto& [name, measured] : times) {
        findings.push_back(medianOf("scan_ns_" + name, measured.scan));
        findings.push_back(medianOf("churn_ns_" + name, measured.churn));
    }
    return findings;
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary =
        "Measures the cost of a linked list, of arrays and of a pool of dead particles, for scans and replacements.";
    info.source = "Thesis";
    info.run = [](ExperimentContext& context) { return measureStorage(context.seed(), 100'000, 25); };
    return info;
}

}  // namespace dustbench::particles::storage
