<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" sourcelanguage="en">
<context>
    <name>Footpoint</name>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check seams and poles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Closed directions and collapsed edges of the selected face, by geometry</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Closest point</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Deviation map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distances of the curve from its poles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Invert point</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nearest point of the selected face, edge or part to a point, with the connecting line and its proof</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nearest points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Parameters of a point on the selected face or edge, and all its preimages</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Point</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pole</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save as CSV</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select a B-spline or Bezier edge, or a polygon.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select a face or a part, and with it a point cloud or a mesh; without one you are asked for a file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select a face or an edge, by a click at the point; or with it a vertex.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select a face, an edge or a part, and a vertex or type a point.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select a face.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Signed distances of a point cloud, a mesh or a file from the selected face or part, as coloured points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The rational curve over the poles of the selected spline or polygon that has wished distances from them</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Weights from distances</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wish</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fair curve</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A curve with less bending and fewer inflections beside the selected edge, within a deviation that is proven</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select an edge.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fair surface</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A surface with less bending beside that of the selected face, within a deviation that is proven; borders and tangents stay</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Inspect</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Least radius of curvature with a proof; comb and inflections of an edge; zebra, isophotes and colours of curvature of a face</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select an edge or a face.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fairing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Greatest deviation</source>
        <translation type="unfinished"></translation>
    </message>
</context>
</TS>
