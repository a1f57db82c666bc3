#------------------------------------------------------------------------------
# gasWithParcels.py - gas, parcels and walls of a finished case in ParaView.
#
#     paraview --script=PATH/gasWithParcels.py     from the folder of the case, or with CASE=/its/folder
#     pvbatch PATH/gasWithParcels.py CASE picture.png [CLOUD]
#                                       without a screen: xvfb-run -a -s -noreset pvbatch ...
#
# Left: a cut through the middle of the domain, coloured by T (by |U| without T), and the
# parcels in flight near it, coloured by carbon conversion, or by temperature where the cloud
# has no carbon. Right, where the mesh is more than one cell thick: the walls behind the cut,
# coloured by the thickness of their deposit, or by their temperature.
#
# ParaView's own reader reads mesh, fields and parcels of OpenFOAM v1912; tried with 5.11.
# Decomposed cases: run reconstructPar first.
#
# Part of nearwall. Copyright (C) the nearwall authors. GPL-3.0-or-later.
#------------------------------------------------------------------------------
import os
import re
import sys

from paraview.simple import *

arguments = sys.argv[1:]
case = os.path.abspath(arguments[0] if arguments else os.environ.get('CASE', os.getcwd()))
picture = arguments[1] if len(arguments) > 1 else None
# The colours of the report of `nearwall report`: light yellow to red, black by blue to white, and blue to yellow
HEAT = ((255, 252, 224), (255, 237, 160), (254, 204, 92), (253, 161, 80), (244, 110, 67), (222, 74, 56))
CHAR_TO_ASH = ((0, 0, 0), (8, 48, 120), (33, 113, 200), (120, 196, 245), (255, 255, 255))
CIVIDIS = ((0, 34, 78), (65, 77, 107), (124, 123, 120), (187, 173, 108), (254, 232, 56))
SLAB = 0.1      # thickness of the slab whose parcels are shown, over the extent of the domain


def stop(reason):
    sys.exit('gasWithParcels.py: ' + reason)


def reader(name, regions):
    source = OpenFOAMReader(registrationName=name, FileName=marker)
    source.MeshRegions = regions
    source.UpdatePipeline(time)
    return source


def carbon_share(cloud):
    """Carbon of a fresh parcel over its mass, from the cloud's properties; None without carbon."""
    try:
        text = re.sub(r'//.*', '', open(f'{case}/constant/{cloud}Properties').read())
    except OSError:
        return None
    mixture = text.partition('singleMixtureFractionCoeffs')[2]
    carbon = re.search(r'\bsolid\b[^{]*\{[^}]*\bC\s+([\d.eE+-]+)\s*;', mixture)
    solid = re.search(r'\bYSolidTot0\s+([\d.eE+-]+)', mixture)
    return float(carbon[1])*float(solid[1]) if carbon and solid and float(carbon[1]) > 0 else None


def point_arrays(source):
    return source.PointData.keys()


def colour(source, view, array, title, colours, place, ends=None, **settings):
    """Shows a source coloured by (association, name), with a scale at a place of the view."""
    shown = Show(source, view)
    for key, value in settings.items():
        setattr(shown, key, value)
    ColorBy(shown, array, separate=True)
    table = shown.LookupTable
    table.ColorSpace = 'RGB'
    table.RGBPoints = [x for place, rgb in enumerate(colours)
                       for x in (place/(len(colours) - 1), *(part/255 for part in rgb))]
    if ends is None:
        shown.RescaleTransferFunctionToDataRange(False, True)
    else:
        table.RescaleTransferFunction(*ends)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ''
    bar.WindowLocation = 'Any Location'
    bar.Orientation, bar.Position, bar.ScalarBarLength = 'Vertical', place, 0.36
    bar.TitleFontSize = bar.LabelFontSize = 16
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.RangeLabelFormat = bar.LabelFormat = '%-.4g'
    shown.SetScalarBarVisibility(view, True)
    return shown


# --- what the case has --------------------------------------------------------

if not os.path.isfile(f'{case}/system/controlDict'):
    stop(f'{case} is no OpenFOAM case; give its folder')
marker = f'{case}/{os.path.basename(case)}.foam'
open(marker, 'a').close()
probe = OpenFOAMReader(registrationName='case', FileName=marker)
probe.UpdatePipelineInformation()
regions = list(probe.MeshRegions.Available)
times = list(probe.TimestepValues) if hasattr(probe.TimestepValues, '__len__') else [probe.TimestepValues]
clouds = [region.partition('/')[2] for region in regions if region.startswith('lagrangian/')]
clouds = [cloud for cloud in clouds if not cloud.endswith('Deposit')]
cloud = arguments[2] if len(arguments) > 2 else (clouds or [None])[0]


def time_of(folder):
    try:
        return float(folder)
    except ValueError:
        return None


with_parcels = [time_of(folder) for folder in os.listdir(case)
                if os.path.isfile(f'{case}/{folder}/lagrangian/{cloud}/positions')]


def has_parcels(time):
    return any(other is not None and abs(other - time) <= 1e-9*abs(time) for other in with_parcels)


time = max((t for t in times if has_parcels(t)), default=times[-1])
Delete(probe)

# --- the gas ------------------------------------------------------------------

view = GetActiveViewOrCreate('RenderView')
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = time
view.ViewTime = time
gas = reader('gas', ['internalMesh'])
bounds = gas.GetDataInformation().GetBounds()
extents = [bounds[2*i + 1] - bounds[2*i] for i in range(3)]
middle = [0.5*(bounds[2*i] + bounds[2*i + 1]) for i in range(3)]
normal = next(i for i in (1, 0, 2) if extents[i] <= 1.01*min(extents))
right, up = [(1, 2), (0, 2), (0, 1)][normal]
origin = list(middle)
origin[normal] += 1e-5*extents[normal]
direction = [float(i == normal) for i in range(3)]
cut = Slice(registrationName='cut', Input=gas, SliceType='Plane')
cut.SliceType.Origin, cut.SliceType.Normal = origin, direction
cut.Triangulatetheslice = False
cut.UpdatePipeline(time)
one_thick = cut.GetDataInformation().GetNumberOfCells() == gas.GetDataInformation().GetNumberOfCells()
has_t = 'T' in cut.CellData.keys()
left = 0.66 if one_thick else 0.60
field, title = (('CELLS', 'T'), 'gas temperature [K]') if has_t else (('CELLS', 'U', 'Magnitude'), 'gas speed [m/s]')
# The viewer sees the axes `right` and `up`; the cut is drawn behind the parcels
viewer = -1 if normal == 1 else 1
behind = [0.0, 0.0, 0.0]
behind[normal] = -viewer*(0.6 if one_thick else 0.5*SLAB)*extents[normal]
colour(cut, view, field, title, HEAT, [left, 0.56], Ambient=1.0, Diffuse=0.0, Position=behind)

# --- the parcels --------------------------------------------------------------

if cloud:
    parcels = reader(cloud, [f'lagrangian/{cloud}'])
    share = carbon_share(cloud)
    if 'active' in point_arrays(parcels):
        parcels = Threshold(registrationName='in flight', Input=parcels, Scalars=['POINTS', 'active'],
                            LowerThreshold=0.5, UpperThreshold=1e9)
    if not one_thick:
        # Gas behind the parcels that are shown, so that none is hidden
        box = Clip(registrationName='slab', Input=parcels, ClipType='Box', Exact=0, Crinkleclip=0)
        lengths = [1.2*extent for extent in extents]
        lengths[normal] = SLAB*extents[normal]
        box.ClipType.Position = [middle[i] - 0.5*lengths[i] for i in range(3)]
        box.ClipType.Length = lengths
        parcels = box
    array, name, ends = 'T', 'parcel temperature [K]', None
    if share and 'YC(s)' in point_arrays(parcels):
        parcels = Calculator(registrationName='conversion', Input=parcels, ResultArrayName='conversion')
        parcels.AttributeType = 'Point Data'
        parcels.Function = f'1 - 3.14159265358979/6*d^3*rho*"YC(s)"/(mass0*{share})'
        array, name, ends = 'conversion', 'carbon conversion [1]', (0.0, 1.0)
    parcels.UpdatePipeline(time)
    if array in point_arrays(parcels):
        colour(parcels, view, ('POINTS', array), name, CHAR_TO_ASH, [left, 0.08], ends, Representation='Point Gaussian',
               GaussianRadius=(0.002 if one_thick else 0.0035)*max(extents), ShaderPreset='Black-edged circle')

# --- the walls ----------------------------------------------------------------

def look(view):
    """Turns a view so that the axes `right` and `up` are those of the picture, without perspective."""
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = middle
    place = list(middle)
    place[normal] += viewer*10*max(extents)
    view.CameraPosition = place
    view.CameraViewUp = [float(i == up) for i in range(3)]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    width, height = view.ViewSize
    # The domain takes the left 60 % of the width, the scales stand on its right
    view.CameraParallelScale = 0.54*max(extents[up], extents[right]*height/(0.6*width))
    shift = 0.36*view.CameraParallelScale*width/height
    view.CameraFocalPoint = [x + shift*float(i == right) for i, x in enumerate(middle)]
    view.CameraPosition = [x + shift*float(i == right) for i, x in enumerate(place)]


layout = GetLayout(view)
size = (1400, 900) if one_thick or 'group/wall' not in regions else (1500, 1100)
if 'group/wall' in regions:
    walls = reader('walls', ['group/wall'])
    arrays = walls.CellData
    found = [(f'{cloud}:layerThickness', 'deposit thickness [m]'), (f'{cloud}:wallTemperature', 'wall temperature [K]'),
             ('T', 'wall temperature [K]')]
    found = [(name, title) for name, title in found if name in arrays.keys() and arrays[name].GetRange()[1] > 0]
    if found and one_thick:
        # Edge-on: the walls are lines
        colour(walls, view, ('CELLS', found[0][0]), found[0][1], CIVIDIS, [0.84, 0.56],
               Representation='Wireframe', LineWidth=7, Ambient=1.0, Diffuse=0.0)
    elif found:
        half = Clip(registrationName='walls behind the cut', Input=walls, ClipType='Plane', Invert=int(viewer > 0))
        half.ClipType.Origin, half.ClipType.Normal = origin, direction
        half.UpdatePipeline(time)
        layout.SplitHorizontal(0, 0.5)
        other = CreateRenderView()
        other.ViewTime = time
        AssignViewToLayout(view=other, layout=layout, hint=2)
        layout.SetSize(*size)
        colour(half, other, ('CELLS', found[0][0]), found[0][1], CIVIDIS, [0.62, 0.56], Ambient=0.4, Diffuse=0.6)
        look(other)

layout.SetSize(*size)
look(view)
text = Text(registrationName='time', Text=f'{os.path.basename(case)}, {cloud or "no parcels"}, time {time:g} s')
Show(text, view, Color=[0, 0, 0], FontSize=16, WindowLocation='Upper Left Corner')
if picture:
    SaveScreenshot(picture, layout, ImageResolution=size)
