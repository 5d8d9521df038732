// Measures the cost of ways to store particles (claim R22): a linked list, an array of structures and a structure of
// arrays, each with and without a pool of dead particles; a hash table and a tree, by serial number.
//
// `scan` ages and moves all particles; `churn` removes the dead and adds newborns. The pool of a list keeps the nodes
// of the dead. That of an array gives their slots to newborns; without it, the survivors are compacted first.
//
// Units: m, m/s, s. Owns: its particles. Threads: one caller at a time.
// Source: Thesis, 3.1.2 (attributes) and 3.1.3 and 3.3.1 (list and pool).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::particles::storage {

/// The attributes of a particle in the thesis.
struct Attributes {
    std::array<float, 3> position{}, velocity{}, acceleration{};
    std::array<float, 4> colour{};
    float size = 1, lifetime = 1, age = 0;
    std::array<float, 3> luminosity{};

    [[nodiscard]] bool isDead() const { return age > lifetime; }
    void live(float seconds) {
        age += seconds;
        for (std::size_t k = 0; k < 3; ++k) {
            velocity[k] += acceleration[k] * seconds;
            position[k] += velocity[k] * seconds;
        }
    }
};

template <bool pool>
class List {
 public:
    List() = default;
    ~List() {
        for (Node* first : {first_, free_})
            while (first) delete std::exchange(first, first->next);
    }
    List(const List&) = delete;
    List& operator=(const List&) = delete;

    void scan(float seconds) {
        for (Node* node = first_; node; node = node->next) node->particle.live(seconds);
    }
    void churn(const std::vector<Attributes>& newborns) {
        sweep();
        refill(newborns);
    }
    /// Removes the dead from the list.
    void sweep() {
        for (Node** link = &first_; *link;) {
            Node* node = *link;
            if (!node->particle.isDead()) {
                link = &node->next;
                continue;
            }
            *link = node->next;
            node->next = free_;
            free_ = node;
        }
    }
    /// Adds newborns; without a pool, the nodes of the dead are freed first.
    void refill(const std::vector<Attributes>& newborns) {
        if constexpr (!pool)
            while (free_) delete std::exchange(free_, free_->next);
        for (const Attributes& newborn : newborns) first_ = make(newborn);
    }
    /// Bytes of a particle with its link.
    static constexpr std::size_t bytesPerParticle() { return sizeof(Node); }
    [[nodiscard]] double sumOfAges() const {
        double sum = 0;
        for (const Node* node = first_; node; node = node->next) sum += static_cast<double>(node->particle.age);
        return sum;
    }

 private:
    struct Node {
        Attributes particle;
        Node* next;
    };

    Node* make(const Attributes& particle) {
        if (!free_) return new Node{particle, first_};
        Node* node = std::exchange(free_, free_->next);
        *node = {particle, first_};
        return node;
    }

    Node *first_ = nullptr, *free_ = nullptr;
};

template <bool pool>
class ArrayOfStructures {
 public:
    void scan(float seconds) {
        for (Attributes& particle : particles_) particle.live(seconds);
    }
    void churn(const std::vector<Attributes>& newborns) {
        std::size_t next = 0;
        if constexpr (pool) {
            for (std::size_t i = 0; i < particles_.size();) {
                if (!particles_[i].isDead()) {
                    ++i;
                } else if (next < newborns.size()) {
                    particles_[i++] = newborns[next++];
                } else {
                    particles_[i] = particles_.back();
                    particles_.pop_back();
                }
            }
        } else {
            std::erase_if(particles_, [](const Attributes& particle) { return particle.isDead(); });
        }
        append(std::span(newborns).subspan(next));
    }
    void append(std::span<const Attributes> newborns) {
        particles_.insert(particles_.end(), newborns.begin(), newborns.end());
    }
    [[nodiscard]] double sumOfAges() const {
        double sum = 0;
        for (const Attributes& particle : particles_) sum += static_cast<double>(particle.age);
        return sum;
    }

 private:
    std::vector<Attributes> particles_;
};

/// An array of structures from whose middle each dead particle is erased, so that all later ones move up.
class ErasedArray {
 public:
    void scan(float seconds) {
        for (Attributes& particle : particles_) particle.live(seconds);
    }
    void churn(const std::vector<Attributes>& newborns) {
        for (std::size_t i = 0; i < particles_.size();)
            if (particles_[i].isDead())
                particles_.erase(particles_.begin() + static_cast<std::ptrdiff_t>(i));
            else
                ++i;
        particles_.insert(particles_.end(), newborns.begin(), newborns.end());
    }
    [[nodiscard]] double sumOfAges() const {
        double sum = 0;
        for (const Attributes& particle : particles_) sum += static_cast<double>(particle.age);
        return sum;
    }

 private:
    std::vector<Attributes> particles_;
};

/// A container of the standard library by serial number, `std::unordered_map` or `std::map`.
template <typename Container>
class Keyed {
 public:
    Keyed() = default;
    explicit Keyed(const typename Container::allocator_type& allocator) : particles_(allocator) {}

    void scan(float seconds) {
        for (auto& [serial, particle] : particles_) particle.live(seconds);
    }
    void churn(const std::vector<Attributes>& newborns) {
        std::erase_if(particles_, [](const auto& entry) { return entry.second.isDead(); });
        for (const Attributes& newborn : newborns) particles_.emplace(serial_++, newborn);
    }
    [[nodiscard]] double sumOfAges() const {
        double sum = 0;
        for (const auto& [serial, particle] : particles_) sum += static_cast<double>(particle.age);
        return sum;
    }

 private:
    std::uint64_t serial_ = 0;
    Container particles_;
};

/// An array without spare capacity: to grow, it allocates again and moves all elements (`std::vector` does so at each
/// doubling of its size). This is the thesis's array if no adjacent memory is free.
class TightArray {
 public:
    void add(const std::vector<Attributes>& newborns) {
        std::vector<Attributes> grown;
        grown.reserve(particles_.size() + newborns.size());
        grown.insert(grown.end(), particles_.begin(), particles_.end());
        grown.insert(grown.end(), newborns.begin(), newborns.end());
        particles_.swap(grown);
    }
    [[nodiscard]] std::size_t size() const { return particles_.size(); }

 private:
    std::vector<Attributes> particles_;
};

template <bool pool>
class StructureOfArrays {
 public:
    void scan(float seconds) {
        const std::size_t count = size();
        age(count, columns_[ageColumn].data(), seconds);
        for (std::size_t k = 0; k < 3; ++k)
            move(count, columns_[k].data(), columns_[3 + k].data(), columns_[6 + k].data(), seconds);
    }
    void churn(const std::vector<Attributes>& newborns) {
        std::size_t next = 0, kept = 0;
        const std::size_t before = size();
        if constexpr (pool) {
            kept = before;
            next = fillHoles(newborns, kept);
        } else {
            for (std::size_t i = 0; i < before; ++i)
                if (!isDead(i)) copy(i, kept++);
        }
        resize(kept + newborns.size() - next);
        for (std::size_t i = kept; next < newborns.size(); ++i) put(newborns[next++], i);
    }
    [[nodiscard]] double sumOfAges() const {
        double sum = 0;
        for (const float value : columns_[ageColumn]) sum += static_cast<double>(value);
        return sum;
    }

 private:
    static constexpr std::size_t lifetimeColumn = 14, ageColumn = 15;

    static void age(std::size_t count, float* __restrict ages, float seconds) {
        for (std::size_t i = 0; i < count; ++i) ages[i] += seconds;
    }
    static void move(std::size_t count, float* __restrict position, float* __restrict velocity,
                     const float* __restrict acceleration, float seconds) {
        for (std::size_t i = 0; i < count; ++i) {
            velocity[i] += acceleration[i] * seconds;
            position[i] += velocity[i] * seconds;
        }
    }
    [[nodiscard]] std::size_t size() const { return columns_[0].size(); }
    [[nodiscard]] bool isDead(std::size_t i) const { return columns_[ageColumn][i] > columns_[lifetimeColumn][i]; }
    void resize(std::size_t count) {
        for (auto& column : columns_) column.resize(count);
    }
    void copy(std::size_t from, std::size_t to) {
        for (auto& column : columns_) column[to] = column[from];
    }
    /// Returns the number of newborns put into slots of the dead; `kept` becomes the new number of particles.
    std::size_t fillHoles(const std::vector<Attributes>& newborns, std::size_t& kept) {
        std::size_t used = 0;
        for (std::size_t i = 0; i < kept;) {
            if (!isDead(i))
                ++i;
            else if (used < newborns.size())
                put(newborns[used++], i++);
            else
                copy(--kept, i);
        }
        return used;
    }
    void put(const Attributes& p, std::size_t i) {
        const std::array<float, 19> values{p.position[0],     p.position[1],   p.position[2],     p.velocity[0],
                                           p.velocity[1],     p.velocity[2],   p.acceleration[0], p.acceleration[1],
                                           p.acceleration[2], p.colour[0],     p.colour[1],       p.colour[2],
                                           p.colour[3],       p.size,          p.lifetime,        p.age,
                                           p.luminosity[0],   p.luminosity[1], p.luminosity[2]};
        for (std::size_t k = 0; k < values.size(); ++k) columns_[k][i] = values[k];
    }

    std::array<std::vector<float>, 19> columns_;
};

/// The experiment `storage`: 100,000 particles, of which 1 in 200 dies per step, after 400 steps.
///
/// scan_list_over_soa, scan_aos_over_soa: time of a scan over that of the structure of arrays, all with a pool.
/// scan_list_over_aos: the cost of the links alone.
/// scan_hash_over_list, scan_tree_over_list: for 25,000 particles, a hash table and a red-black tree over
/// the list, all without a pool; each of nine times with new nodes.
/// churn_without_over_with_list, …_aos, …_soa: time of removing dead particles and adding newborns, without the pool
/// over with it.
/// allocation_without_over_with_list: the same without the walk that finds the dead: time of freeing and allocating
/// nodes, over that of taking them from the pool.
/// churn_aos_over_list: the same for the array over the list, both with the pool.
/// churn_erased_array_over_list: for 10,000 particles, an array from whose middle each dead particle is erased.
/// growth_array_over_list: time to grow from nothing to 100,000 particles in 200 steps: an array that doubles its
/// capacity, over a list; growth_moved_array_over_list: an array that is moved completely at each step.
/// bytes_list_over_array: bytes of a particle with its link over those of the particle; …_of_places: of a particle with
/// only a position, a control. bytes_hash_over_list, bytes_tree_over_list: bytes that a hash table and a tree allocate
/// per particle over those of the list; bytes_list_over_list: of the
/// standard library's list, a control.
/// scan_twice: an array scanned twice over once, a control.
/// allocation_of_equals, churn_of_equals, growth_of_equals, scan_of_equals: controls, one list and one array of
/// structures measured twice. scan_ns_…, churn_ns_…: nanoseconds per particle and step, by `list`, `aos`, `soa`, with
/// `_pool`.
[[nodiscard]] DUSTBENCH_API ExperimentInfo describe();
[[nodiscard]] std::vector<Finding> measureStorage(std::uint64_t seed, std::size_t particles, int repetitions);

}  // namespace dustbench::particles::storage
