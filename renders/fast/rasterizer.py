"""One asset on the rasterizer: uploaded once, then drawn shot by shot."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import moderngl
import numpy as np

from artgen.core.camera import Camera
from artgen.core.errors import RenderError
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.core.transform import apply
from artgen.export.glb_content import Skin
from artgen.imaging import Singles
from artgen.transport import CLEAR
from renders.fast.filtered import split_sum
from renders.fast.light import Shine
from renders.fast.occlusion import Occlusion, sky_factors
from renders.fast.shaders import DEFINES, OPAQUE, PANE, VERTEX
from renders.glb import Appearance, Look

Box = tuple[int, int, int, int]
Owned = (
    moderngl.Buffer
    | moderngl.Texture
    | moderngl.TextureArray
    | moderngl.Texture3D
    | moderngl.VertexArray
)
FINER = 2
"""Images are drawn so many times finer along each side. In software this costs half of what
multisampling by four does, and smooths highlights and textures too."""
MIRRORED, SPLIT_SUM, SEEN_SKY, SEEN_LIGHTS = 0, 5, 6, 7
"""Texture units; those between hold a surface's images."""
UNITS = {
    "mirrored": MIRRORED,
    "split_sum": SPLIT_SUM,
    "seen_sky": SEEN_SKY,
    "seen_lights": SEEN_LIGHTS,
}
SRGB8 = 0x8C41
"""GL_SRGB8: the texture unit makes linear light of it, before it interpolates."""
THROUGH = (moderngl.ONE, 0x88F9, moderngl.ZERO, 0x8589)
"""Dual-source blending (GL_SRC1_COLOR, GL_SRC1_ALPHA): color = light + passed * color; the fourth
channel holds transparency, which panes multiply."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Piece:
    """A skin on the rasterizer.

    Attributes:
        corners: (8, 3) of its box, object frame at rest, m.
    """

    skin: Skin
    surface: SurfaceSpec
    program: moderngl.Program
    array: moderngl.VertexArray
    images: tuple[moderngl.Texture, ...]
    corners: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class Shade:
    """An `Occlusion` on the rasterizer."""

    sky: moderngl.Texture3D
    lights: moderngl.Texture3D
    grid: tuple[float, ...]


class Canvas:
    """Where images are drawn; windows use its lower corner, which costs no more than a small one
    would."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._frame: moderngl.Framebuffer | None = None

    def cleared(self, size: tuple[int, int]) -> moderngl.Framebuffer:
        """One that is at least (width, height), current, and empty there."""
        frame, gl = self._frame, self._context
        if frame is None or frame.width < size[0] or frame.height < size[1]:
            wide, high = (
                max(pair) for pair in zip(size, frame.size if frame else size, strict=True)
            )
            if frame is not None:
                for attachment in (*frame.color_attachments, frame.depth_attachment, frame):
                    attachment.release()
            color = gl.renderbuffer((wide, high), 4, dtype="f4")
            frame = self._frame = gl.framebuffer(color, gl.depth_renderbuffer((wide, high)))
        frame.use()
        gl.viewport = (0, 0, *size)
        frame.clear(0.0, 0.0, 0.0, 1.0, depth=1.0, viewport=(0, 0, *size))
        return frame


class Programs:
    """Shaders by the images they read, compiled when first needed, and the table they share."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._made: dict[tuple[str, ...], moderngl.Program] = {}
        table = split_sum()
        self.split_sum = context.texture(
            (table.shape[1], table.shape[0]), 2, table.tobytes(), dtype="f4"
        )
        self.split_sum.repeat_x = self.split_sum.repeat_y = False

    def opaque(self, kinds: Sequence[str], lights: int) -> moderngl.Program:
        """For a surface with images of these kinds under so many lights."""
        return self._program(OPAQUE, (f"LIGHTS {lights}", *(DEFINES[kind] for kind in kinds)))

    def pane(self) -> moderngl.Program:
        """For thin glass."""
        return self._program(PANE, ("PANE",))

    def _program(self, source: str, names: tuple[str, ...]) -> moderngl.Program:
        if names not in self._made:
            head, _, body = source.lstrip().partition("\n")
            defines = "".join(f"#define {name}\n" for name in names)
            self._made[names] = self._context.program(
                vertex_shader=VERTEX.lstrip(), fragment_shader=f"{head}\n{defines}{body}"
            )
        return self._made[names]


class Rasterizer:
    """One asset under one rig; close it to free what it uploaded."""

    def __init__(
        self,
        context: moderngl.Context,
        programs: Programs,
        canvas: Canvas,
        *,
        appearance: Appearance,
        surfaces: Mapping[str, SurfaceSpec],
        light: Shine,
    ) -> None:
        self._context, self._canvas, self._programs = context, canvas, programs
        self._lights = len(light.corners)
        self._owned: list[Owned] = []
        self._textures: dict[tuple[str, str], moderngl.Texture] = {}
        self._pieces = [
            self._piece(skin, surfaces[skin.surface], appearance.looks[skin.surface])
            for skin in appearance.skins
        ]
        self._mirrored = self._surroundings(light)
        for program in {piece.program for piece in self._pieces}:
            _light(program, light)

    def close(self) -> None:
        """Free buffers and textures."""
        for item in self._owned:
            item.release()

    def shade(self, found: Occlusion) -> Shade:
        """What is in the way of light, where `draw` finds it."""
        images = []
        for values in (found.sky, found.lights):
            deep, high, wide, _ = values.shape
            image = self._context.texture3d((wide, high, deep), 4, values.tobytes(), dtype="f2")
            image.repeat_x = image.repeat_y = image.repeat_z = False
            self._owned.append(image)
            images.append(image)
        return Shade(sky=images[0], lights=images[1], grid=(*found.low, found.cell))

    def draw(
        self,
        camera: Camera,
        box: Box,
        poses: Mapping[str, Floats],
        *,
        part: str | None,
        shade: Shade | None,
    ) -> Singles:
        """(h, w, 4) linear, premultiplied: the window `box` of what `camera` sees.

        Args:
            part: the only part in the scene, or None for all.
            shade: of this scene; None where nothing is opaque.

        Raises:
            RenderError: there is no such part.
        """
        size = (box[2] - box[0], box[3] - box[1])
        fine = (FINER * size[0], FINER * size[1])
        shown = [piece for piece in self._pieces if part in (None, piece.skin.part)]
        if not shown:
            raise RenderError(f"the GLB shows no part {part}; generate the asset anew")
        gl = self._context
        drawn = self._canvas.cleared(fine)
        gl.front_face = "cw"  # rows run downward, so triangles turn the other way
        gl.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self._mirrored.use(MIRRORED)
        self._programs.split_sum.use(SPLIT_SUM)
        clip = clip_from_world(camera, box, _reach(shown, camera, poses))
        if shade is not None:
            shade.sky.use(SEEN_SKY)
            shade.lights.use(SEEN_LIGHTS)
        for program in {piece.program for piece in shown}:
            program["eye"] = tuple(camera.position)
            if shade is not None and "grid" in program:
                program["grid"] = shade.grid
        gl.cull_face = "back"
        ordered = _near_to_far(shown, camera, poses)
        for piece in ordered:
            if not is_pane(piece.surface):
                self._draw(piece, clip, poses[piece.skin.part])
        self._blend([piece for piece in reversed(ordered) if is_pane(piece.surface)], clip, poses)
        raw = drawn.read(viewport=(0, 0, *fine), components=4, dtype="f4")
        return _filtered(np.frombuffer(raw, np.float32).reshape(fine[1], fine[0], 4))

    def _blend(self, panes: Sequence[Piece], clip: Floats, poses: Mapping[str, Floats]) -> None:
        """Panes from far to near over what is behind them; of each the far face first."""
        gl, drawn = self._context, self._context.fbo
        gl.enable(moderngl.BLEND)
        gl.blend_func = THROUGH  # type: ignore[assignment]  # the stub knows two of the four
        drawn.depth_mask = False
        for piece in panes:
            for hidden in ("front", "back"):
                gl.cull_face = hidden
                self._draw(piece, clip, poses[piece.skin.part])
        drawn.depth_mask = True

    def _draw(self, piece: Piece, clip: Floats, pose: Floats) -> None:
        program, surface = piece.program, piece.surface
        _write(program, "clip_from_rest", (clip @ pose).T)
        _write(program, "object_from_rest", pose.T)
        for key, value in _numbers(surface).items():
            if key in program:
                program[key] = value
        for unit, texture in enumerate(piece.images, start=1):
            texture.use(unit)
        piece.array.render()

    def _piece(self, skin: Skin, surface: SurfaceSpec, look: Look) -> Piece:
        pane = is_pane(surface)
        kinds = [] if pane else [kind for kind in DEFINES if getattr(look, kind) is not None]
        program = self._programs.pane() if pane else self._programs.opaque(kinds, self._lights)
        for unit, kind in enumerate(kinds, start=1):
            program[f"{kind}_image"] = unit
        rows = np.concatenate([skin.vertices, skin.normals, skin.uv], axis=1).astype("f4")
        gl = self._context
        vertices, indices = gl.buffer(rows.tobytes()), gl.buffer(skin.faces.tobytes())
        layout = [("3f", "in_position"), ("3f", "in_normal"), ("2f", "in_uv")]
        used = [name if name in program else None for _, name in layout]
        form = " ".join(
            kind if name else kind.replace("f", "x4")
            for (kind, _), name in zip(layout, used, strict=True)
        )
        array = gl.vertex_array(
            program, [(vertices, form, *(name for name in used if name))], indices
        )
        self._owned += [array, vertices, indices]
        low, high = skin.vertices.min(axis=0), skin.vertices.max(axis=0)
        corners = np.stack(np.meshgrid(*np.stack([low, high], axis=1)), axis=-1).reshape(8, 3)
        return Piece(
            skin=skin,
            surface=surface,
            program=program,
            array=array,
            images=tuple(self._texture(surface.name, kind, look) for kind in kinds),
            corners=corners,
        )

    def _texture(self, surface: str, kind: str, look: Look) -> moderngl.Texture:
        if (surface, kind) not in self._textures:
            pixels = getattr(look, kind)
            light = SRGB8 if kind in ("color", "emission") else None
            texture = self._context.texture(
                pixels.shape[1::-1], 3, pixels.tobytes(), alignment=1, internal_format=light
            )
            texture.build_mipmaps()
            texture.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
            self._owned.append(texture)
            self._textures[surface, kind] = texture
        return self._textures[surface, kind]

    def _surroundings(self, light: Shine) -> moderngl.TextureArray:
        layers, height, width, _ = light.mirrored.shape
        texture = self._context.texture_array(
            (width, height, layers), 3, light.mirrored.tobytes(), dtype="f4"
        )
        texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
        texture.repeat_y = False
        self._owned.append(texture)
        return texture


def clip_from_world(camera: Camera, box: Box, reach: tuple[float, float]) -> Floats:
    """(4, 4) projection to the window `box`, rows downward; `reach` is (near, far) m."""
    left, top, right, bottom = box
    width, height = right - left, bottom - top
    near, far = reach
    x, y = camera.center
    projection = np.zeros((4, 4))
    projection[0, 0], projection[0, 2] = 2 * camera.focal / width, 2 * (x - left) / width - 1
    projection[1, 1], projection[1, 2] = 2 * camera.focal / height, 2 * (y - top) / height - 1
    projection[2, 2], projection[2, 3] = (far + near) / (far - near), -2 * far * near / (far - near)
    projection[3, 2] = 1.0
    return np.asarray(projection @ camera.camera_from_world)


def _near_to_far(
    pieces: Sequence[Piece], camera: Camera, poses: Mapping[str, Floats]
) -> list[Piece]:
    """Near surfaces first hide what is behind them before it is shaded; panes need the opposite."""

    def depth(piece: Piece) -> float:
        middle = apply(poses[piece.skin.part], piece.corners.mean(axis=0))
        return float(apply(camera.camera_from_world, middle)[2])

    return sorted(pieces, key=depth)


def _reach(
    pieces: Sequence[Piece], camera: Camera, poses: Mapping[str, Floats]
) -> tuple[float, float]:
    """Clip planes (m) around the pieces."""
    depths = [
        apply(camera.camera_from_world @ poses[piece.skin.part], piece.corners)[:, 2]
        for piece in pieces
    ]
    nearest, farthest = float(np.min(depths)), float(np.max(depths))
    return max(0.9 * nearest, 1e-3 * farthest), 1.1 * farthest


def _filtered(fine: Singles) -> Singles:
    """(h, w, 4) from an image FINER times as fine, transparency turned into alpha: a tent two
    pixels wide, the nearest to Cycles' filter of 1.5 pixels that four by four points allow."""
    padded = np.pad(fine, ((1, 1), (1, 1), (0, 0)), mode="edge")
    rows = 3.0 * (padded[1:-2:2] + padded[2:-1:2]) + (padded[0:-3:2] + padded[3::2])
    image = 3.0 * (rows[:, 1:-2:2] + rows[:, 2:-1:2]) + (rows[:, 0:-3:2] + rows[:, 3::2])
    image /= np.float32(64.0)
    image[..., 3] = 1.0 - image[..., 3]
    return image


def _light(program: moderngl.Program, light: Shine) -> None:
    """Everything that stays while the rig does."""
    _write(program, "sky", light.sky)
    _write(program, "stage", np.array([*light.middle, light.reach]))
    wide, high = (
        light.corners[:, 3] - light.corners[:, 0],
        light.corners[:, 1] - light.corners[:, 0],
    )
    face = np.cross(high, wide)
    area = np.linalg.norm(face, axis=1, keepdims=True)
    _write(program, "middles", light.corners.mean(axis=1))
    _write(program, "faces", np.concatenate([face / area, area], axis=1))
    _write(program, "radiance", light.radiance)
    _write(program, "open_sky", sky_factors(light).sum(axis=0))
    for name, unit in UNITS.items():
        if name in program:
            program[name] = unit


def _write(program: moderngl.Program, name: str, values: Floats) -> None:
    """Set a uniform, unless the compiler found that the shader does not need it."""
    uniform = program.get(name, None)
    if isinstance(uniform, moderngl.Uniform):
        uniform.write(np.asarray(values, "f4", order="C").tobytes())


def is_pane(surface: SurfaceSpec) -> bool:
    """True where light passes: every glass is drawn as a thin pane."""
    return surface.transmission > CLEAR


def _numbers(surface: SurfaceSpec) -> dict[str, object]:
    if is_pane(surface):
        return {
            "index": surface.ior,
            "tint": surface.color,
            "roughness": surface.roughness,
        }
    bent = (surface.ior - 1.0) / (surface.ior + 1.0)
    return {
        "color": surface.color,
        "glow": (surface.emission,) * 3,
        "roughness": surface.roughness,
        "metallic": surface.metallic,
        "specular": bent * bent,
    }
