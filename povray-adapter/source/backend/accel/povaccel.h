/*******************************************************************************
 * povaccel.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for povaccel.cpp:
 * Bounding_Method=3, which answers POV-Ray's ray queries through the accel
 * library. It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *
 * One object of class Accelerator belongs to each scene. It is made with the
 * scene's options, built once by the bounding task, and only queried after that,
 * so that all render threads share it. All state of a query is on the stack of
 * the thread that runs it.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCEL_H
#define POVRAY_BACKEND_POVACCEL_H

#include <atomic>
#include <set>
#include <string>
#include <vector>

#include "base/povmscpp.h"
#include "backend/frame.h"
#include "backend/render/trace.h"
#include "backend/support/statistics.h"
#include "backend/accel/accel.h"
#include "backend/accel/povaccelbox.h"
#include "backend/accel/povaccelframe.h"

namespace pov
{

class AccelCsg;
class AccelMesh;
class MessageFactory;
class Mesh;
class SceneData;
class Task;
struct AccelQuery;
struct AccelPointQuery;

/// What the meshes of a scene came to.
struct AccelMeshTotals
{
	std::atomic<POV_ULONG> meshes, built, triangles, loose, bytes, milliseconds;

	AccelMeshTotals() : meshes(0), built(0), triangles(0), loose(0), bytes(0), milliseconds(0) { }
};

class Accelerator
{
		friend class AccelMesh;
	public:
		/// Takes what concerns this module from the options of a scene.
		explicit Accelerator(POVMS_Object& options);
		~Accelerator();

		/// Is this Bounding_Method=3?
		bool IsChosen() const { return chosen; }

		/// Warns of options without effect. Throws if the configuration is not valid.
		void CheckOptions(const SceneData& scene) const;

		/// Learns the objects of the scene, and gives structures to the CSG objects of many parts.
		void TakeObjects(const SceneData& scene);

		/// Builds the structure over the objects taken. Throws if it cannot, or if the user stops the task.
		void Build(const SceneData& scene, Task& task);

		/// Finds the object nearest along a ray, nearer than bestisect.Depth, as a linear search would.
		bool FindIntersection(Trace& trace, Trace::CooperateFunctor& cooperate, TraceThreadData *thread, Intersection& bestisect,
		                      const Ray& ray) const;
		bool FindIntersection(Trace& trace, Trace::CooperateFunctor& cooperate, TraceThreadData *thread, Intersection& bestisect,
		                      const Ray& ray, const RayObjectCondition& precondition, const RayObjectCondition& postcondition) const;

		/// Appends the interiors of all objects around a point, as a linear search would.
		void FindContainingInteriors(const VECTOR point, AccelContainerSearch search, TraceThreadData *thread, RayInteriorVector& interiors) const;

		/// Describes the structure for the parser statistics.
		void GetStatistics(POVMS_Object& parserStats) const;

		/// Describes what a render built of a lazy structure, what is not usual, and the result of Accelerator_Verify.
		void GetStatistics(POVMS_Object& renderStats, const RenderStatistics& stats) const;

		/// Did Accelerator_Verify find a difference, or a hit outside its box, anywhere in this process?
		static bool FaultWasFound();
	private:
		/// was method 3 asked for?
		bool chosen;
		/// was an option given that needs method 3?
		bool mentioned;
		/// compare each answer with a linear search?
		bool verify;
		/// the configuration, in the library's words
		std::string config;
		/// are there so few objects that testing each takes less time than any structure?
		bool few;
		static const size_t MOST_FEW = 8;
		/// the objects that a ray can hit, in the order of the scene
		vector<ObjectPtr> objects;
		/// those whose leaf test changes what the next one finds
		std::set<ObjectPtr> changing;
		/// number of light sources left out, as no ray can hit them
		size_t lightsLeftOut;
		/// of each search: objects that points outside their box may be in, or that have none, in the order of the scene
		vector<uint32_t> beyondBoxes[ACCEL_OF_PHOTONS + 1];
		/// has any object an interior?
		bool interiorsExist;
		/// the structures inside CSG objects
		vector<AccelCsg *> csg;
		/// for messages from the render threads, which outlive no scene
		const SceneData *sceneData;

		/// The library's structure over objects, with boxes for rays that begin within its reach.
		struct Part
		{
			AccelReach reach;
			accel *structure; // NULL until built
			vector<uint32_t> unbounded; // the objects that the structure leaves out, rising
			bool bounds; // are there others?
			vector<accel_box> boxes; // kept for Accelerator_Verify alone
			std::atomic<bool> built;
			std::atomic<POV_ULONG> queries; // of all but the first

			Part() : structure(NULL), bounds(false), built(false), queries(0) { }
		};

		/// for the first part, until it is built: boxes, and what Find_Insides says
		vector<accel_box> nearBoxes, insides;
		/// rays along directions for which leaf tests may be wrong by much
		AccelGrazings grazings;
		/// for most rays, for rays from farther and farther away, and for grazing ones, each built when the first one comes
		mutable Part parts[ACCEL_REACHES];

		/// objects with a hit outside their box that were named in a message
		mutable std::set<uint32_t> namedOutside;

		mutable AccelMeshTotals meshTotals;

		class BoxCheck;

		void BuildSeenMeshes(const vector<accel_ray>& pilot, Task& task) const;
		void BuildPart(Part& part, vector<accel_box>& boxes, const accel_hooks *hooks, accel_error& error) const;
		const Part *FarPart(const Ray& ray, Trace::CooperateFunctor& cooperate) const;
		const Part *BuiltPart(Part& part, Trace::CooperateFunctor& cooperate) const;
		bool Find(Trace& trace, Trace::CooperateFunctor& cooperate, AccelQuery& query) const;
		inline bool FindInPart(const Part& part, AccelQuery& query, accel_query& counters, uint32_t& index) const;
		bool FindAmongFew(AccelQuery& query, uint32_t& index) const;
		void Verify(Trace& trace, const AccelQuery& query, const Part *part, DBL limit, bool found, uint32_t index) const;
		void VerifyInteriors(const AccelPointQuery& query) const;
		void FindBeyondBoxes();
		void VerifyMesh(const Intersection& isect, Mesh& mesh, const Ray& ray, DBL closest, const RayObjectCondition *postcondition, TraceThreadData *thread, bool found) const;
		void VerifyMesh(Mesh& mesh, const Ray& ray, const vector<Intersection>& found, TraceThreadData *thread) const;
		void VerifyMesh(const Mesh& mesh, const VECTOR point, TraceThreadData *thread, bool inside) const;
		void ReportOutside(const AccelQuery& query, const accel_box& box, uint32_t index, DBL depth) const;
		void ReportDifference(TraceThreadData *thread, const std::string& query, const std::string& ours, const std::string& linear) const;
		std::string DescribeObject(uint32_t index) const;
		std::string Describe(bool found, uint32_t index, const Intersection& isect) const;

		static MessageFactory Messages(const SceneData& scene);

		/// not available
		Accelerator(const Accelerator&);
		Accelerator& operator=(const Accelerator&);
};

}

#endif // POVRAY_BACKEND_POVACCEL_H
