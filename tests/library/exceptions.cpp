// SPDX-License-Identifier: Apache-2.0
//
// A C++ exception leaves a callback through every kind and every query; the structure is as
// before, and nothing was allocated on the way.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "accel/accel.h"

namespace
{

struct Host {
    bool throws;
    unsigned calls;
};

void intersect(accel_probe *probe)
{
    Host *host = static_cast<Host *>(probe->user);
    host->calls++;
    if (host->throws)
        throw std::string("out of the callback");
    accel_report(probe, 1.5 + probe->prim, 0, 0);
}

bool stop(void *, const accel_hit *)
{
    throw std::string("out of the visitor");
}

bool stop_id(void *, accel_id)
{
    throw std::string("out of the visitor");
}

size_t held = 0;

void *count(void *, void *old, size_t from, size_t to)
{
    held = held - from + to;
    if (to == 0) {
        std::free(old);
        return nullptr;
    }
    return std::realloc(old, to);
}

bool check(bool good, const char *kind, const char *what)
{
    if (!good)
        std::printf("%s: %s\n", kind, what);
    return good;
}

template <class Query> bool caught(Query query)
{
    try {
        query();
    } catch (const std::string &) {
        return true;
    }
    return false;
}

bool test(const char *kind)
{
    std::vector<accel_box> boxes;
    for (int i = 0; i < 100; i++)
        boxes.push_back({{-1, -1, 1.0 + i}, {1, 1, 2.0 + i}});
    Host host = {true, 0};
    accel_geometry g = {};
    g.type = ACCEL_OBJECTS;
    g.objects.boxes = boxes.data();
    g.objects.count = static_cast<uint32_t>(boxes.size());
    g.objects.intersect = intersect;
    g.objects.user = &host;
    const accel_scene scene = {&g, 1};
    accel_hooks hooks = {};
    hooks.resize = count;
    accel *a;
    accel_error error;
    if (accel_build(&a, &scene, kind, &hooks, &error) != ACCEL_OK)
        return check(false, kind, error.text);
    const double org[3] = {0, 0, 0}, dir[3] = {0, 0, 1}, inside[3] = {0, 0, 1.5};
    const accel_ray ray = accel_ray_from(org, dir);
    accel_hit hit;
    const size_t before = held;
    bool good = true;
    for (int i = 0; i < 100; i++) {
        host.throws = true;
        good &= check(caught([&] { accel_closest(a, &ray, &hit, nullptr); }), kind, "closest");
        good &= check(caught([&] { accel_any(a, &ray, nullptr); }), kind, "any");
        good &= check(caught([&] { accel_all(a, &ray, stop, nullptr, nullptr); }), kind, "all");
        host.throws = false;
        good &= check(caught([&] { accel_all(a, &ray, stop, nullptr, nullptr); }), kind, "visitor");
        good &= check(caught([&] { accel_point(a, inside, stop_id, nullptr, nullptr); }), kind,
                      "point visitor");
        good &= check(accel_closest(a, &ray, &hit, nullptr) && hit.t == 1.5 && hit.prim == 0, kind,
                      "a query after an exception");
    }
    good &= check(held == before, kind, "a query allocated");
    accel_free(a);
    return good & check(held == 0, kind, "free left memory");
}

} // namespace

int main()
{
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    bool good = kinds > 0;
    for (size_t i = 0; i < kinds; i++)
        good &= test(kind[i]->name);
    std::printf("%zu kinds, %s\n", kinds, good ? "fine" : "FAILED");
    return good ? 0 : 1;
}
