// Shapes made by OCCT's own modelling: what a caller has in hand. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef FOOTPOINT_TEST_SHAPES_HXX
#define FOOTPOINT_TEST_SHAPES_HXX

#include <TopoDS_Shape.hxx>

#include <string>
#include <utility>
#include <vector>

/** The bottle of OCCT's tutorial without its thread: cut box with rounded sides, fillets, neck. */
TopoDS_Shape bottle();
/** A block with a hole, all of whose edges are rounded by different radii. */
TopoDS_Shape filleted_block();
/** A smooth skin through a circle, an ellipse and a rounded square. */
TopoDS_Shape loft();
/** A circle swept along a spiral of splines. */
TopoDS_Shape sweep();
/** A propeller-like thin blade: a loft of thin profiles, whose sides are near to each other. */
TopoDS_Shape blade();

/** All of them, each written as BREP and read again; some as STEP too where OCCT's data exchange is installed. */
std::vector<std::pair<std::string, TopoDS_Shape>> real_shapes();

#endif
