/*******************************************************************************
 * povaccelstatistics.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module says what Bounding_Method=3 built, and what it found out while rays
 * were traced, in the statistics of parser and render. It is a derivative work of
 * POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include <boost/format.hpp>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccel.h"
#include "backend/accel/povaccelcsg.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using boost::format;

static std::string Describe_Structure(const accel_info& info, size_t unbounded, size_t lightsLeftOut)
{
	std::string text = str(format("Accelerator:      %s\n") % info.config);

	text += str(format("  Objects:        %10d   Unbounded:       %10d   Lights left out: %d\n") % info.primitives % unbounded % lightsLeftOut);
	if(info.clusters > 0)
		text += str(format("  Clusters:       %10d   Size classes:    %10d\n") % info.clusters % info.size_classes);
	text += str(format("  Nodes:          %10d   Leaves:          %10d   Maximum depth: %d\n") % info.nodes % info.leaves % info.depth);
	text += str(format("  References:     %10d   Memory:       %9d KiB   Peak: %d KiB\n") % info.references % ((info.bytes + 1023) / 1024) % ((info.peak_bytes + 1023) / 1024));
	text += str(format("  Build time:     %10.3f s") % info.seconds);
	for(uint32_t i = 0; i < info.phase_count; i++)
		text += str(format("%s %s %.3f") % ((i == 0) ? " =" : " +") % info.phases[i].name % info.phases[i].seconds);
	text += "\n";
	for(uint32_t i = 0; i < info.left_out_count; i++)
		text += str(format("  Left out: %s: %d bytes, %.2g s\n") % info.left_out[i].what % info.left_out[i].bytes % info.left_out[i].seconds);
	for(uint32_t i = 0; i < info.note_count; i++)
		text += str(format("  Note: %s\n") % info.notes[i]);

	return text;
}

void Accelerator::GetStatistics(POVMS_Object& parserStats) const
{
	if(parts[0].structure != NULL)
	{
		accel_info info;

		accel_describe(parts[0].structure, &info);
		std::string text = Describe_Structure(info, parts[0].unbounded.size(), lightsLeftOut);

		if(few)
			text += "  Note: with so few objects rays test each, and the structure is not asked\n";
		parserStats.SetString(kPOVAttrib_AcceleratorText, text.c_str());
	}
	else if(chosen)
		parserStats.SetString(kPOVAttrib_AcceleratorText, "Accelerator:      none, linear search (bounding is off, or there are few objects)\n");
}

/// What rays have built of a lazy structure.
static std::string Describe_Built(const accel *structure)
{
	accel_info info;

	accel_describe(structure, &info);
	if((info.unbuilt_clusters == 0) && (info.lazy_bytes == 0))
		return "";

	const POV_ULONG bounded = info.primitives - info.skipped - info.degenerate - info.unbounded;

	return str(format("Accelerator built:    %d of %d clusters, %d of %d objects, %d KiB\n") %
	           (info.clusters - info.unbuilt_clusters) % info.clusters % (bounded - info.unbuilt_primitives) % bounded %
	           ((info.lazy_bytes + 1023) / 1024));
}

/// What was built for rays that begin far from the camera, or along grazing directions.
static std::string Describe_Part(const accel *structure, POV_ULONG queries, const std::string& name, const std::string& which)
{
	accel_info info;

	accel_describe(structure, &info);

	return str(format("Accelerator %-10s%13d   (rays %s, for which %d KiB were built in %.3f s)\n") %
	           (name + ":") % queries % which % ((info.bytes + 1023) / 1024) % info.seconds);
}

/// What was built inside CSG objects, and what it spared.
static std::string Describe_Csg(const vector<AccelCsg *>& csg, const RenderStatistics& stats)
{
	const POV_ULONG queries = stats[Accel_Csg_Queries], spared = stats[Accel_Csg_Parts_Passed_Over];
	size_t built = 0, parts = 0, bytes = 0;

	for(vector<AccelCsg *>::const_iterator i = csg.begin(); i != csg.end(); i++)
	{
		if((*i)->IsBuilt())
		{
			built++;
			parts += (*i)->PartCount();
			bytes += (*i)->Bytes();
		}
	}
	if(csg.empty())
		return "";

	return str(format("Accelerator CSG:      %d of %d built over %d parts, %d KiB; %d queries passed over %d parts\n") % built % csg.size() % parts %
	           ((bytes + 1023) / 1024) % queries % spared);
}

/// What rays have built in meshes.
static std::string Describe_Meshes(const AccelMeshTotals& totals)
{
	std::string text = str(format("Accelerator meshes:   %d of %d built, %d triangles, %d KiB, %.3f s\n") %
	                       totals.built % totals.meshes % totals.triangles % ((totals.bytes + 1023) / 1024) % (totals.milliseconds / 1000.0));

	if(totals.loose > 0)
		text += str(format("Accelerator loose:    %13d   (triangles of meshes that are flat as they are rounded; any ray may meet them)\n") % totals.loose);

	return text;
}

void Accelerator::GetStatistics(POVMS_Object& renderStats, const RenderStatistics& stats) const
{
	const POV_ULONG outside = stats[Accel_Hits_Outside];
	const POV_ULONG refused = stats[Accel_Rays_Refused];
	const POV_ULONG verified = stats[Accel_Queries_Verified];
	const POV_ULONG different = stats[Accel_Queries_Different];
	const POV_ULONG spared = stats[Accel_Shadow_Tests_Spared];
	std::string text;

	if(parts[0].structure != NULL)
		text += Describe_Built(parts[0].structure);
	for(int i = 1; i < ACCEL_REACHES; i++)
	{
		const bool grazing = (i == ACCEL_REACHES - 1);

		if(parts[i].built)
			text += Describe_Part(parts[i].structure, parts[i].queries, grazing ? "grazing" : "far",
			                      grazing ? "along which leaf tests are not exact" : str(format("from over %.2g away") % parts[i - 1].reach.radius));
	}
	text += Describe_Csg(csg, stats);
	if(meshTotals.meshes > 0)
		text += Describe_Meshes(meshTotals);
	if(spared > 0)
		text += str(format("Accelerator shadows:  %13d   (tests spared of the object in the shadow cache, just found not hit)\n") % spared);
	if(verified > 0)
		text += str(format("Accelerator verified: %13d   Differences:     %15d\n") % verified % different);
	if(refused > 0)
		text += str(format("Accelerator refused:  %13d   (rays that are not finite, or begin too far away; searched linearly)\n") % refused);
	if(verified > 0)
		text += str(format("Accelerator outside:  %13d   (of all hits of all objects: outside the box of their object)\n") % outside);
	else if(outside > 0)
		text += str(format("Accelerator outside:  %13d   (hits before the box of their object, which may be too small)\n") % outside);
	if(text.empty() == false)
		renderStats.SetString(kPOVAttrib_AcceleratorText, text.c_str());
}

}
